-- A minute of feelings: rest, a shy smile, laughter, surprise, fear, anger, sadness, rest. Each has seven and a half
-- seconds and stands at its fullest in their middle, where a contact sheet looks. What is felt is said.
-- CC0-1.0

local function at(seconds)
    wait(math.max(0, seconds - now()))
end

local function ha(strength)
    feel("jawOpen", 0.16 + 0.3 * strength, {over = 0.07, ease = "ease-out"})
    feel("headPitch", -0.04 - 0.1 * strength, {over = 0.09})
    wait(0.1)
    feel("jawOpen", 0.1 + 0.1 * strength, {over = 0.09})
    feel("headPitch", -0.02 - 0.05 * strength, {over = 0.1})
    wait(0.09 + 0.02 * random())
end

-- 0: rest.
at(0.4)
say("Nothing yet. Only breath.", {over = 5.6})
at(2.6)
look(9, -2)
at(4.4)
look(0, 0)
at(5.4)
blink()

-- 7.5: a look that is met, and then not.
at(6.6)
feel("joy", 0.35, {over = 0.9})
at(7.5)
say("A look is met: a shy smile, a blush.", {over = 6})
blend({joy = 0.25, shySmile = 0.9}, {over = 1.1})
at(8.4)
feel("blush", 1, {over = 2.2})
look(-11, 8)
at(10.4)
look(0, 1)
at(12.2)
blink()
look(9, 7)
at(13.6)
look(0, 0)

-- 15: held back, and then not.
at(14.4)
blend({duchenneSmile = 0.6, AU24 = 0.6, blush = 0.5}, {over = 0.5})
at(15.2)
say("It cannot be held back: laughter.", {over = 5.6})
at(15.6)
for burst = 1, 4 do
    local strength = 1.1 - 0.15 * burst
    blend({laughter = 0.6 + 0.4 * strength, AU7 = 0.5, AU43 = 0.25 * strength, blush = 0.35, exercise = 0.35},
        {over = 0.18})
    for _ = 1, 6 do
        ha(strength * (0.85 + 0.15 * random()))
    end
    feel({laughter = 0.55, AU43 = 0}, {over = 0.2})
    wait(0.16)
end
release("jawOpen", {over = 0.4})
release("headPitch", {over = 0.6})
blend({joy = 0.4, exercise = 0.2}, {over = 0.8})

-- 22.5: a sound.
at(23.4)
look(22, -5)
at(23.6)
say("A sound! Surprise.", {over = 5})
feel("headPitch", -0.05, {over = 0.2})
blend({surprise = 1}, {over = 0.16, ease = "ease-out"})
at(24.4)
blink()
look(14, -3)
at(26)
look(17, -2)

-- 30: and it comes nearer.
at(29)
say("It comes nearer: the pallor of fear.", {over = 6.2})
blend({fear = 0.95}, {over = 0.6})
feel("pallor", 1, {over = 2.6})
feel("headPitch", 0.04, {over = 1})
at(30.6)
look(-10, -2)
at(31.7)
look(13, -3)
at(32.7)
look(4, -2)
at(35.4)
look(0, 0)

-- 37.5: only somebody who thought it funny. The brows come down first.
at(36.6)
blend({fear = 0.4, anger = 0.45, pallor = 0.3}, {over = 0.8})
at(37.5)
say("Only a joke? The flush of anger.", {over = 6})
feel("headPitch", 0.1, {over = 1})
blend({anger = 1, exercise = 0.55}, {over = 1})
look(0, 0)
at(39.4)
for _ = 1, 5 do
    feel("anger", 0.85 + 0.15 * random(), {over = 0.3})
    wait(0.35)
end
at(43.4)
release("headPitch", {over = 1})

-- 45: what is left of it.
at(43.8)
blend({anger = 0.3, sadness = 0.4, exercise = 0.2}, {over = 1.1})
at(45)
say("And then it is only sad.", {over = 5.6})
blend({sadness = 1}, {over = 1.4})
look(-4, 14)
feel("headPitch", 0.12, {over = 1.6})
feel("headRoll", -0.06, {over = 2})
at(48)
blink()
at(50.6)
feel("sadness", 0.7, {over = 1})

-- 52.5: back.
at(51.8)
look(0, 0)
release("headPitch", {over = 1.4})
release("headRoll", {over = 1.4})
blend({sadSmile = 0.4}, {over = 1.2})
at(52.8)
say("Breathe. It is over.", {over = 5})
at(53.8)
blend({joy = 0.16}, {over = 1.6})
at(57)
blend({}, {over = 1.6})
look()
at(60)
