-- A smile that is held back as long as it can be, and then is not. Breath and bursts: about five "ha" a second, as people
-- laugh (Provine 1996), each burst weaker than the one before.
-- CC0-1.0

local function ha(strength)
    feel("jawOpen", 0.12 + 0.25 * strength, {over = 0.07, ease = "ease-out"})
    feel("headPitch", -0.03 - 0.1 * strength, {over = 0.09})
    wait(0.1)
    feel("jawOpen", 0.08 + 0.08 * strength, {over = 0.09})
    feel("headPitch", -0.02 - 0.05 * strength, {over = 0.1})
    wait(0.09 + 0.02 * random())
end

wait(0.5)
feel("duchenneSmile", 0.4, {over = 0.8})
wait(0.7)
-- Lips pressed together do not help for long.
feel({duchenneSmile = 0.6, AU24 = 0.7}, {over = 0.4})
wait(0.9)

feel("exercise", 0.5, {over = 6})
for burst = 1, 3 do
    local strength = 1.1 - 0.25 * burst
    blend({laughter = 0.55 + 0.45 * strength, AU7 = 0.6, AU43 = 0.2 * strength, exercise = 0.5}, {over = 0.18})
    for _ = 1, 9 - 2 * burst do
        ha(strength * (0.8 + 0.2 * random()))
    end
    -- Drawing breath.
    feel({laughter = 0.5, AU43 = 0}, {over = 0.3})
    feel("jawOpen", 0.12, {over = 0.3})
    wait(0.45)
end

release("jawOpen", {over = 0.5})
release("headPitch", {over = 0.8})
blend({joy = 0.45, exercise = 0.3}, {over = 0.9})
wait(1.8)
blend({joy = 0.15}, {over = 1.5})
