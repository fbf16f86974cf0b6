-- Somebody who waits: now and then something crosses the mind. Never ends.
-- CC0-1.0

local thoughts = {
    {"a little joy", {joy = 0.2}},
    {"a doubt", {AU4 = 0.25, AU14_L = 0.2}},
    {"a memory", {sadness = 0.2}},
    {"interest", {AU1 = 0.3, AU2 = 0.35}},
    {"the lips want moving", {AU24 = 0.4}},
    {"a small smile to oneself", {duchenneSmile = 0.3}},
}

every(4, function()
    wait(1.5 * random())
    local thought = thoughts[random(#thoughts)]
    blend(thought[2], {over = 0.6 + 0.5 * random()})
    wait(1 + random())
    blend({}, {over = 1.2})
end)
