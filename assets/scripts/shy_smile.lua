-- A look that is met, and then not: joy rises into a shy smile, and the cheeks flush a second later.
-- CC0-1.0

look(0, 0)
wait(0.8)
wait(feel("joy", 0.35, {over = 0.9}))

-- The smile is held back, and the gaze goes down and aside before the head does.
blend({shySmile = 0.9}, {over = 1.1})
wait(0.35)
look(12, 8)
wait(0.65)
feel("blush", 0.9, {over = 2.5})
wait(2.6)

-- One look up to see whether it was seen; it was.
look(1, 1)
feel("joy", 0.3, {over = 0.5})
wait(1.0)
blink()
look(9, 6)
feel({joy = 0.15, shySmile = 0.6}, {over = 0.8})
wait(1.6)

blend({joy = 0.12, blush = 0.35}, {over = 2})
look(0, 0)
wait(2.2)
blend({}, {over = 2.5})
