-- Waits for somebody to poke it: blush play default --script poke --event 1=poke --event 3=poke --event 4=poke
-- The first time surprises it, the second annoys it; after that it has had enough, until it is left alone for a while.
-- CC0-1.0

local pokes, last = 0, -100

on("poke", function()
    pokes = now() - last < 5 and pokes + 1 or 1
    last = now()
    local mine = pokes
    blink()
    look(random(-8, 8), random(-2, 6))
    if mine == 1 then
        blend({surprise = 0.7}, {over = 0.12})
        wait(0.5)
        blend({surprise = 0.1, joy = 0.3}, {over = 0.6})
    elseif mine == 2 then
        blend({surprise = 0.3, anger = 0.25}, {over = 0.15})
        wait(0.5)
        blend({anger = 0.35, AU14_R = 0.4}, {over = 0.5})
    else
        blend({anger = math.min(1, 0.5 + 0.2 * mine)}, {over = 0.2})
        feel("headYaw", 0.08, {over = 0.3})
    end
    wait(0.6)
    look(0, 0)
    wait(2.5)
    if now() - last > 3 then
        blend({}, {over = 1.5})
        release("headYaw", {over = 1})
        look()
    end
end)
