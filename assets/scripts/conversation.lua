-- Listening to a friend: nods in the right places, a shared joke, bad news, comfort. The words are the friend's.
-- CC0-1.0

local function nod(times)
    for _ = 1, times do
        feel("headPitch", 0.09, {over = 0.16})
        wait(0.17)
        feel("headPitch", -0.01, {over = 0.2})
        wait(0.2)
    end
    release("headPitch", {over = 0.3})
end

say("So, I finally asked for the day off.", {over = 2})
feel({AU1 = 0.3, AU2 = 0.35}, {over = 0.4})
wait(1.2)
start(nod, 2)
wait(1)

say("He thought that it was for a wedding.", {over = 2})
blend({AU1 = 0.4, AU2 = 0.4, socialSmile = 0.4}, {over = 0.5})
wait(1.1)
blend({joy = 0.75}, {over = 0.45})
blink()
wait(1.5)

say("It is for the hospital. It is my father.", {over = 2.4})
wait(0.7)
-- A smile takes a moment to understand that it must go.
blend({joy = 0.2, AU1 = 0.5}, {over = 0.5})
look(0, 0)
wait(0.5)
blend({surprise = 0.25, sadness = 0.45}, {over = 0.5})
wait(0.7)
blend({sadness = 0.8}, {over = 0.9})
wait(0.6)
look(-8, 12)
wait(1.1)

say("They say that he will be fine.", {over = 2})
look(0, 0)
feel("headRoll", 0.07, {over = 0.9})
blend({sadSmile = 0.75}, {over = 1.2})
wait(1)
start(nod, 1)
wait(1.6)
release("headRoll", {over = 1.5})
blend({sadSmile = 0.25}, {over = 1.6})
look()
wait(1.6)
