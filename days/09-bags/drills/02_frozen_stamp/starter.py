"""Foretell: which line is written for the third message? Write it between quotes, for
example "0.3 s old", then check."""

ANSWER = None


class Clock:
    now_s = 100.0


class Sensor:
    def __init__(self, clock):
        self.stamp_s = clock.now_s

    def message(self):
        return {"stamp_s": self.stamp_s, "distance": 1.25}


clock = Clock()
sensor = Sensor(clock)
for _ in range(3):
    message = sensor.message()
    print(f"{clock.now_s - message['stamp_s']:.1f} s old")
    clock.now_s += 0.5
