"""Draw the robot from outside: `python site/pictures/draw_robot.py FOLDER`.

Three drawings for `site/pages/reference/pictures`: all computers with what they say to each other,
and the wires of a distance sensor and of a motor driver. Pins of the board are those of the sketch
in `labs/serial-bridge/firmware`, names of topics those of the labs' cards.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from sheet import AMBER, BLACK, BLUE, GREEN, RED, Sheet

PWM, DIRECTION, SECOND = (6, 7), (22, 23), (24, 25)
"""Pins of the left and the right motor on the board: PWM, and two for the direction."""


def distance_sensor() -> Sheet:
    """An HC-SR04 on a Raspberry Pi: its echo is 5 V, and the Pi's pins bear 3.3 V."""
    sheet = Sheet(
        "The wires of a distance sensor",
        "Left the sensor HC-SR04 with the pins VCC, Trig, Echo and GND. Right a Raspberry Pi with"
        " 5 V (pin 2), GPIO 23 (pin 16), GPIO 24 (pin 18) and GND (pin 6). VCC goes to 5 V, Trig to"
        " GPIO 23, GND to GND. Echo goes through a resistor of 1 kΩ to GPIO 24, and from there"
        " through a resistor of 2 kΩ to GND. So 5 V become 3.3 V.",
        height=380,
    )
    sheet.box((20, 60), (130, 240), line=GREEN)
    sheet.text((85, 46), "HC-SR04", bold=True)
    for y in (125, 235):
        sheet.circle((70, y), 34)
        sheet.circle((70, y), 20)
    sheet.box((570, 60), (130, 240), line=BLUE)
    sheet.text((635, 46), "Raspberry Pi", bold=True)
    rows = (
        (90, "VCC", "5 V (pin 2)", RED),
        (150, "Trig", "GPIO 23 (16)", BLUE),
        (210, "Echo", "GPIO 24 (18)", AMBER),
        (270, "GND", "GND (pin 6)", BLACK),
    )
    for y, sensor, pi, colour in rows:
        sheet.wire((150, y), (570, y), colour=colour)
        sheet.text((142, y + 5), sensor, anchor="end", size=15)
        sheet.text((578, y + 5), pi, anchor="start", size=15)
    sheet.resistor((240, 199), (84, 22))
    sheet.text((282, 190), "1 kΩ")
    sheet.wire((410, 210), (410, 270))
    sheet.resistor((399, 222), (22, 36))
    sheet.text((430, 246), "2 kΩ", anchor="start")
    sheet.dot((410, 210), AMBER)
    sheet.dot((410, 270))
    sheet.text((205, 236), "5 V", colour=RED)
    sheet.text((492, 200), "3.3 V", colour=GREEN)
    sheet.text((360, 336), "5 V x 2 kΩ / (1 kΩ + 2 kΩ) = 3.3 V: the divider saves the Pi's pin.")
    sheet.text((360, 362), "An Arduino Mega bears 5 V: there, Echo needs no resistor.")
    return sheet


def motor_driver() -> Sheet:
    """An L298N between board, battery and motors."""
    left, right = (f"{PWM[side]}, {DIRECTION[side]}, {SECOND[side]}" for side in (0, 1))
    sheet = Sheet(
        "The wires of a motor driver",
        "Left an Arduino Mega, in the middle the motor driver L298N, right two motors, below a"
        f" battery. The pins {left} go to ENA, IN1, IN2, and the pins {right} to ENB, IN3, IN4."
        " OUT1 and OUT2 feed the left motor, OUT3 and OUT4 the right one. The battery goes through"
        " an emergency stop to 12V. The grounds of battery, driver and board are joined.",
        height=470,
    )
    sheet.box((20, 60), (130, 300), line=BLUE)
    sheet.text((85, 46), "Arduino Mega", bold=True)
    sheet.box((330, 60), (170, 300), line=GREEN)
    sheet.text((415, 46), "L298N", bold=True)
    _signals(sheet)
    for y, name, ends in ((120, "left", (100, 140)), (240, "right", (220, 260))):
        sheet.circle((640, y), 42)
        sheet.text((640, y + 6), "M", bold=True, size=20)
        sheet.text((640, y + 64), f"{name} motor")
        for number, end in enumerate(ends, 1 if name == "left" else 3):
            sheet.wire((500, end), (603, end), colour=AMBER)
            sheet.text((492, end + 5), f"OUT{number}", anchor="end", size=15)
    _power(sheet)
    return sheet


def _signals(sheet: Sheet) -> None:
    names = (("ENA", "IN1", "IN2"), ("ENB", "IN3", "IN4"))
    for side, top in ((0, 90), (1, 200)):
        pins = (f"{PWM[side]} (PWM)", str(DIRECTION[side]), str(SECOND[side]))
        for place, (pin, name) in enumerate(zip(pins, names[side], strict=True)):
            y, colour = top + 32 * place, RED if place == 0 else BLUE
            sheet.wire((150, y), (330, y), colour=colour)
            sheet.text((142, y + 5), pin, anchor="end", size=15)
            sheet.text((338, y + 5), name, anchor="start", size=15)
    sheet.text((240, 80), "how fast", size=15, colour=RED)
    sheet.text((240, 180), "which way", size=15, colour=BLUE)


def _power(sheet: Sheet) -> None:
    sheet.text((142, 325), "GND", anchor="end", size=15)
    sheet.text((338, 325), "GND", anchor="start", size=15)
    sheet.text((492, 325), "12V", anchor="end", size=15)
    sheet.wire((150, 320), (330, 320))
    sheet.box((330, 400), (170, 50), "battery", line=BLACK)
    sheet.wire((240, 320), (240, 425), (330, 425))
    sheet.dot((240, 320))
    sheet.text((340, 390), "minus", anchor="start", size=15)
    sheet.text((490, 390), "plus", anchor="end", size=15)
    sheet.box((545, 362), (155, 50), "emergency stop", line=RED)
    sheet.wire((500, 425), (530, 425), (530, 440), (622, 440), (622, 412), colour=RED)
    sheet.wire((622, 362), (622, 320), (500, 320), colour=RED)


def whole_robot() -> Sheet:
    """The rover of the course, with all nodes that its days build."""
    sheet = Sheet(
        "The whole rover",
        "Three computers. On the laptop /drive_client (day 5) and /e_stop_button (day 10). On the"
        " Raspberry Pi /drive_server (day 5), /guard (day 10), /serial_bridge (day 6), /camera and"
        " /ball_finder (day 7). The Arduino Mega with motors and encoders. /drive_client gives"
        " /drive_to to /drive_server, which says /cmd_vel_raw to /guard. /e_stop_button says"
        " /e_stop to /guard, which says /cmd_vel to /serial_bridge. The bridge sends lines M over"
        " the USB cable, and gets lines W; it says /odom to /drive_server. /camera says"
        " /camera/image_raw to /ball_finder, which says /ball.",
        height=560,
    )
    sheet.area((16, 16), (190, 400), "laptop")
    sheet.area((226, 16), (478, 400), "Raspberry Pi")
    sheet.area((226, 440), (478, 104), "Arduino Mega")
    sheet.node((111, 100), "/drive_client", 150)
    sheet.node((111, 240), "/e_stop_button", 160)
    sheet.node((440, 100), "/drive_server", 150)
    sheet.node((440, 240), "/guard", 110)
    sheet.node((440, 366), "/serial_bridge", 150)
    sheet.node((620, 240), "/ball_finder", 130)
    sheet.node((620, 100), "/camera", 110)
    for at, day in (
        ((111, 140), 5),
        ((111, 280), 10),
        ((440, 68), 5),
        ((524, 276), 10),
        ((548, 380), 6),
        ((620, 68), 7),
    ):
        sheet.text(at, f"day {day}", size=15, colour=GREEN)
    _said(sheet)
    sheet.box((410, 484), (130, 44), "motors", line=RED)
    sheet.box((560, 484), (130, 44), "encoders", line=AMBER)
    sheet.text((250, 512), "day 6: the sketch", anchor="start", size=15, colour=GREEN)
    return sheet


def _said(sheet: Sheet) -> None:
    sheet.arrow((186, 100), (364, 100))
    sheet.text((285, 90), "/drive_to")
    sheet.arrow((440, 121), (440, 218))
    sheet.text((430, 192), "/cmd_vel_raw", anchor="end")
    sheet.arrow((191, 240), (384, 240))
    sheet.text((285, 230), "/e_stop")
    sheet.arrow((440, 261), (440, 344))
    sheet.text((450, 310), "/cmd_vel", anchor="start")
    sheet.arrow((365, 366), (250, 366), (250, 150), (400, 150), (400, 118))
    sheet.text((258, 340), "/odom", anchor="start")
    sheet.arrow((620, 121), (620, 218))
    sheet.text((612, 150), "/camera/image_raw", anchor="end", size=15)
    sheet.arrow((620, 261), (620, 320))
    sheet.text((630, 306), "/ball", anchor="start")
    sheet.arrow((425, 387), (425, 440))
    sheet.arrow((455, 440), (455, 389))
    sheet.text((417, 434), "M", anchor="end", bold=True)
    sheet.text((463, 434), "W", anchor="start", bold=True)
    sheet.text((520, 434), "lines on the USB cable", anchor="start", size=15)


DRAWN: dict[str, Callable[[], Sheet]] = {
    "whole-robot.svg": whole_robot,
    "distance-sensor.svg": distance_sensor,
    "motor-driver.svg": motor_driver,
}
"""Name of the file to what draws it."""


def main(folder: Path) -> None:
    """Write all three."""
    for name, draw in DRAWN.items():
        (folder / name).write_text(draw().svg(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
