-- Something startles; fear holds the face, and turns into anger when it proves to be nobody but you.
-- CC0-1.0

wait(0.7)
look(16, -4)
feel({surprise = 0.8}, {over = 0.12, ease = "ease-out"})
wait(0.45)

blend({fear = 0.9}, {over = 0.35})
feel("pallor", 0.6, {over = 1.5})
-- Eyes that search, and a head that draws back.
for _, side in ipairs({20, 10, -6}) do
    look(side + 2 * random(), -2)
    wait(0.4 + 0.2 * random())
end

-- It has been seen. The brows come down first, the lids last.
look(0, 0)
feel("headPitch", 0.1, {over = 1.6})
blend({fear = 0.45, anger = 0.4, pallor = 0.3}, {over = 0.8})
wait(0.7)
feel("pallor", 0, {over = 1})
wait(blend({anger = 1}, {over = 0.9}))
for _ = 1, 3 do
    feel("anger", 0.8 + 0.2 * random(), {over = 0.3})
    wait(0.35)
end
wait(0.9)

release("headPitch", {over = 1.2})
blend({anger = 0.2}, {over = 1.4})
wait(1.4)
blend({}, {over = 1.2})
