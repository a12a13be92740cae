"""Draw what each lab makes move: `python site/pictures/draw_labs.py FOLDER`.

`labs/LAB/pictures/moves.svg` stands at the head of the lab's task. Names, texts and numbers are
those of the lab's card. It moves by CSS, again and again, and its first look is one that tells all:
who asks for less motion sees it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from rover import (
    COLOURS,
    DARK,
    FLOOR,
    GREY,
    ball,
    bubble,
    button,
    flag,
    floor,
    laptop,
    placed,
    rover,
    waves,
)
from sheet import AMBER, BLACK, GREEN, RED, Sheet

HEIGHT = 230
ROOM = (14.0, 14.0, 692.0, 202.0)
LANES = (92.0, 168.0)
"""Middle of each of two lanes."""


def _room(title: str, told: str) -> Sheet:
    sheet = Sheet(title, told, HEIGHT)
    sheet.add(floor(*ROOM))
    return sheet


def _moved(
    name: str, seconds: float, steps: str, how: str = "ease-in-out", *, rests: str = ""
) -> str:
    """A rule of CSS: what has the class `name` goes through `steps`, for ever.

    Where nothing may move, it `rests` there.
    """
    rest = f" transform: {rests};" if rests else ""
    rule = f".{name} {{{rest} animation: {name} {seconds:g}s {how} infinite }}"
    return f"{rule} @keyframes {name} {{ {steps} }}"


def _right(pixels: float) -> str:
    return f"translateX({pixels:g}px)"


def _by_turns(names: list[str], seconds: float, first: str) -> str:
    """One after the other is seen; where nothing moves, it is `first`."""
    share = 100 / len(names)
    rules = [
        _moved(
            name,
            seconds,
            f"0%, {share * place:g}% {{ opacity: 0 }} {share * place + 1:g}%,"
            f" {share * (place + 1):g}% {{ opacity: 1 }}"
            f" {min(100, share * (place + 1) + 1):g}%, 100% {{ opacity: 0 }}",
            "step-end",
        )
        for place, name in enumerate(names)
    ]
    hidden = ", ".join(f".{name}" for name in names if name != first)
    return f"{hidden} {{ opacity: 0 }} {' '.join(rules)}"


def nodes() -> Sheet:
    """It tells how it is."""
    sheet = _room(
        "The rover in its room tells how it is, again and again",
        "The rover stands in a room. Over it stands Robot status count: 0, then 1, then 2: your"
        " node /minimal_publisher says it on /robot_status.",
    )
    sheet.add(placed(210, 160, rover(scale=1.7)))
    sheet.add(placed(210, 128, waves(), turned=-90))
    for number in range(3):
        words = bubble(f"Robot status count: {number}")
        sheet.add(placed(210, 90, words, name=f"n{number}"))
    sheet.node((540, 90), "/minimal_publisher", 200)
    sheet.arrow((540, 112), (540, 148))
    sheet.box((460, 150), (160, 36), "/robot_status", line=GREEN)
    sheet.moves(_by_turns(["n0", "n1", "n2"], 3, "n2"))
    return sheet


def topics() -> Sheet:
    """One says, one hears."""
    sheet = _room(
        "The rover hears what the talker says, sentence by sentence",
        "On the left the node /talker says sentences on /chatter. On the right the rover hears"
        " them, as /listener does. Over it stands Hello robotics 0, then 1, then 2.",
    )
    sheet.node((110, 150), "/talker", 120)
    sheet.wire((172, 150), (264, 150), colour=GREEN)
    sheet.box((264, 132), (120, 36), "/chatter", line=GREEN)
    sheet.arrow((384, 150), (500, 150), colour=GREEN)
    sheet.add(placed(178, 150, f'<circle r="9" fill="{AMBER}"/>', name="message"))
    sheet.add(placed(570, 150, rover(scale=1.7)))
    for number in range(3):
        sheet.add(placed(570, 98, bubble(f"Hello robotics {number}"), name=f"n{number}"))
    sheet.text((570, 204), "/listener", size=15)
    go = "0% { transform: translateX(0) } 90%, 100% { transform: translateX(310px) }"
    sheet.moves(
        _moved("message", 1.5, go, "linear") + " " + _by_turns(["n0", "n1", "n2"], 4.5, "n0")
    )
    return sheet


def distance_sensor() -> Sheet:
    """It measures, and warns."""
    sheet = _room(
        "The rover drives to a wall, and warns before it is there",
        "The rover drives to a wall. Waves of sound go from its nose to the wall. Nearer than"
        " 0.3 m, /distance_subscriber says true on /obstacle.",
    )
    sheet.add(f'<rect x="628" y="44" width="28" height="142" rx="5" fill="{GREY}"/>')
    wave = placed(48, 0, waves(), name="wave")
    sheet.add(placed(470, 120, rover(scale=1.7), wave, name="drive"))
    sheet.add(placed(330, 70, bubble("/obstacle: true", line=RED), name="warn"))
    sheet.text((330, 196), "nearer than 0.3 m", size=15)
    sheet.arrow((420, 190), (500, 190))
    sheet.moves(
        _moved(
            "drive",
            5,
            "0% { transform: translateX(-350px) } 60%, 85% { transform:"
            " translateX(20px) } 100% { transform: translateX(-350px) }",
            rests=_right(20),
        )
        + " "
        + _moved(
            "warn",
            5,
            "0%, 50% { opacity: 0 } 54%, 88% { opacity: 1 } 92%, 100% { opacity: 0 }",
            "linear",
        )
        + " "
        + _moved("wave", 0.8, "0% { opacity: 1 } 100% { opacity: 0.1 }", "ease-out")
    )
    return sheet


def services() -> Sheet:
    """A limit that is asked for."""
    sheet = _room(
        "The rover drives fast, and then slowly: it was given a limit",
        "Two ways of the rover. In the upper lane it drives 1.0 m/s. In the lower lane"
        " /set_max_speed was asked with data: true; the answer is max speed: 0.3 m/s, and the"
        " rover is slower.",
    )
    for lane, words, name in (
        (LANES[0], "before: 1.0 m/s", "fast"),
        (LANES[1], "after /set_max_speed: 0.3 m/s", "slow"),
    ):
        sheet.text((36, lane - 30), words, anchor="start", size=15)
        sheet.add(_line(40, lane, 680))
        sheet.add(placed(90, lane, rover(scale=1.2), name=name))
    sheet.add(placed(560, 72, bubble("max speed: 0.3 m/s", line=AMBER)))
    way = f"0% {{ transform: none }} 100% {{ transform: {_right(540)} }}"
    sheet.moves(
        _moved("fast", 2.4, way, "linear", rests=_right(400))
        + " "
        + _moved("slow", 8, way, "linear", rests=_right(120))
    )
    return sheet


def actions() -> Sheet:
    """To a point, and it tells how far it is."""
    sheet = _room(
        "The rover drives to a flag, and tells on the way how far it still is",
        "The rover drives along a dotted line to a flag, the goal of /drive_to. On the way it tells"
        " the distance: 1.83 m, then 1.78 m. Then the rover is there.",
    )
    sheet.add(_line(110, 160, 560))
    sheet.add(placed(590, 168, flag()))
    sheet.add(placed(110, 160, rover(scale=1.5), name="drive"))
    for words, name in (
        ("Distance: 1.83 m", "n0"),
        ("Distance: 1.78 m", "n1"),
        ("The rover is there", "n2"),
    ):
        sheet.add(placed(340, 100, bubble(words), name=name))
    sheet.text((590, 196), "goal of /drive_to", size=15)
    sheet.moves(
        _moved(
            "drive",
            6,
            "0%, 6% { transform: none } 66%, 100% { transform: translateX(430px) }",
            rests=_right(200),
        )
        + " "
        + _by_turns(["n0", "n1", "n2"], 6, "n1")
    )
    return sheet


def serial_bridge() -> Sheet:
    """Commands to the wheels, and their speeds back."""
    sheet = _room(
        "The rover drives: commands go over a cable, and what the wheels do comes back",
        "On the left the node /serial_bridge hears /cmd_vel and tells /odom and /wheel_speed."
        " Lines go over a cable to the Arduino Mega, and lines come back. The rover drives.",
    )
    sheet.box((36, 40), (110, 32), "/cmd_vel", line=GREEN)
    sheet.arrow((91, 72), (91, 94))
    sheet.node((112, 117), "/serial_bridge", 156)
    sheet.arrow((91, 138), (91, 162))
    sheet.box((36, 164), (90, 32), "/odom", line=GREEN)
    sheet.arrow((140, 138), (200, 162))
    sheet.box((140, 164), (126, 32), "/wheel_speed", line=GREEN)
    sheet.wire((190, 117), (330, 117))
    sheet.box((330, 86), (130, 62), "Arduino Mega")
    for name, colour, y in (("there", RED, 110), ("back", AMBER, 124)):
        sheet.add(placed(200, y, f'<circle r="6" fill="{colour}"/>', name=name))
    sheet.add(_line(490, 117, 690))
    sheet.add(placed(530, 117, rover(scale=1.5), name="drive"))
    go = "0% { transform: none } 100% { transform: translateX(120px) }"
    return_ = "0% { transform: translateX(120px) } 100% { transform: none }"
    sheet.moves(
        _moved("there", 1, go, "linear")
        + " "
        + _moved("back", 1, return_, "linear")
        + " "
        + _moved(
            "drive",
            4,
            "0%, 100% { transform: none } 50% { transform: translateX(110px) }",
            rests=_right(60),
        )
    )
    return sheet


def pi_camera() -> Sheet:
    """A ball that rolls is found."""
    sheet = _room(
        "The rover looks at a ball that rolls, and finds it in the picture",
        "The rover looks at a red ball that rolls. Beside it the picture /ball/image of the node"
        " /ball_finder: a circle stands where the ball is.",
    )
    sheet.add(f'<path d="M150 115L380 40V190Z" fill="{AMBER}" fill-opacity="0.2"/>')
    sheet.add(placed(110, 115, rover(scale=1.7)))
    sheet.add(placed(340, 100, ball(), name="roll"))
    sheet.add(
        f'<rect x="440" y="56" width="220" height="124" rx="4" fill="#ffffff" stroke="{DARK}"'
        ' stroke-width="4"/>'
    )
    ring = f'<circle r="24" fill="none" stroke="{GREEN}" stroke-width="4"/>'
    sheet.add(placed(580, 106, ball(16), ring, name="seen"))
    sheet.text((550, 44), "/ball/image", size=15)
    sheet.text((550, 204), "/ball_finder", size=15)
    sheet.moves(
        _moved(
            "roll",
            4,
            "0%, 100% { transform: translateY(-34px) } 50% { transform: translateY(50px) }",
        )
        + " "
        + _moved(
            "seen",
            4,
            "0%, 100% { transform: translateX(-90px) } 50% { transform: translateX(30px) }",
        )
    )
    return sheet


def bring_up() -> Sheet:
    """Two start at once, each with its own limit."""
    sheet = _room(
        "Two rovers start with one command, and the red one drives faster than the blue one",
        "The command ros2 launch starts two rovers. The red one has the limit 0.6 m/s of"
        " /red/speed_limiter, the blue one 0.4 m/s of /blue/speed_limiter. Both drive, the red one"
        " farther.",
    )
    sheet.box((32, 96), (116, 38), "ros2 launch", line=BLACK)
    far = {"red": 360, "blue": 240}
    for lane, name, limit in ((LANES[0] - 12, "red", "0.6"), (LANES[1] + 8, "blue", "0.4")):
        sheet.arrow((148, 115), (190, lane))
        sheet.text((196, lane - 34), f"/{name}/speed_limiter: {limit} m/s", anchor="start", size=15)
        sheet.add(_line(200, lane, 680))
        sheet.add(placed(240, lane, rover(COLOURS[name], scale=1.4), name=name))
    rules = (
        _moved(
            name,
            5,
            f"0%, 10% {{ transform: none }} 90%, 100% {{ transform: {_right(pixels)} }}",
            "linear",
            rests=_right(pixels),
        )
        for name, pixels in far.items()
    )
    sheet.moves(" ".join(rules))
    return sheet


def black_box() -> Sheet:
    """Each message of a drive is kept, and one is missing."""
    sheet = _room(
        "The rover drives, and each of its messages is kept in a bag, but for a gap",
        "The rover drives. Below it its messages stand in a row, one after another, with a gap"
        " where some are missing. Your program black_box reads them, and tells what happened.",
    )
    sheet.add(_line(40, 84, 680))
    sheet.add(placed(90, 84, rover(scale=1.4), name="drive"))
    for place in range(22):
        if place not in (13, 14, 15):
            colour = "#e8793a" if place % 2 else AMBER
            x = 60 + 26 * place
            sheet.add(f'<rect x="{x}" y="140" width="16" height="22" rx="3" fill="{colour}"/>')
    to_come = f'<rect x="-584" y="134" width="584" height="34" fill="{FLOOR}"/>'
    sheet.add(placed(640, 0, to_come, name="hides"))
    sheet.text((60, 196), "the bag: each message, and its time", anchor="start", size=15)
    sheet.text((430, 196), "a gap", size=15, colour=RED)
    sheet.moves(
        _moved(
            "drive",
            6,
            "0% { transform: none } 90%, 100% { transform: translateX(530px) }",
            "linear",
            rests=_right(530),
        )
        + " "
        + _moved(
            "hides",
            6,
            "0% { transform: none } 90%, 100% { transform: scaleX(0) }",
            "linear",
            rests="scaleX(0)",
        )
    )
    return sheet


def e_stop() -> Sheet:
    """Pressed here, it stands there."""
    sheet = _room(
        "A button is pressed on a laptop, and the rover stops",
        "On the left a laptop with a red button, the node /e_stop_button. It is pressed, and says"
        " so on /e_stop. On the right the rover stops: /guard writes Stopped: the stop is pressed.",
    )
    sheet.add(placed(100, 104, laptop()))
    sheet.add(placed(100, 100, button(22), name="press"))
    sheet.text((100, 176), "/e_stop_button", size=15)
    sheet.wire((170, 104), (214, 104), colour=AMBER)
    sheet.box((214, 86), (96, 36), "/e_stop", line=GREEN)
    sheet.arrow((310, 104), (352, 104), colour=AMBER)
    sheet.add(_line(370, 130, 690))
    sheet.add(placed(400, 130, rover(scale=1.5), name="drive"))
    sheet.add(placed(530, 84, bubble("Stopped: the stop is pressed", line=RED), name="says"))
    sheet.text((530, 194), "/guard", size=15)
    sheet.moves(
        _moved(
            "drive",
            5,
            "0% { transform: none } 50%, 92% { transform: translateX(140px) } 100% {"
            " transform: none }",
            "linear",
            rests=_right(140),
        )
        + " "
        + _moved(
            "says",
            5,
            "0%, 48% { opacity: 0 } 52%, 90% { opacity: 1 } 94%, 100% { opacity: 0 }",
            "linear",
        )
        + " "
        + _moved(
            "press",
            5,
            "0%, 44% { transform: none } 48%, 60% { transform: scale(0.8) }"
            " 66%, 100% { transform: none }",
        )
    )
    return sheet


def wander() -> Sheet:
    """Along a wall, and before what moves it stands."""
    sheet = _room(
        "The rover drives along a wall, waits for something that moves, and drives on",
        "The rover drives along a wall on its left, 0.4 m away. A grey thing rolls over its"
        " way, and the rover stands until it is gone. Then it drives on.",
    )
    sheet.add(f'<rect x="30" y="44" width="650" height="22" rx="5" fill="{GREY}"/>')
    sheet.add(_line(50, 134, 680))
    sheet.text((120, 102), "0.4 m", size=15)
    sheet.arrow((90, 118), (90, 70))
    sheet.add(placed(470, 190, f'<circle r="16" fill="{GREY}"/>', name="thing"))
    sheet.add(placed(90, 134, rover(scale=1.4), name="drive"))
    sheet.text((300, 196), "/scan in, /cmd_vel out", size=15)
    sheet.moves(
        _moved(
            "drive",
            8,
            "0% { transform: none } 30%, 60% { transform: translateX(260px) }"
            " 95%, 100% { transform: translateX(540px) }",
            "linear",
            rests=_right(260),
        )
        + " "
        + _moved(
            "thing",
            8,
            "0%, 15% { transform: none } 30%, 45% { transform: translateY(-56px) }"
            " 58%, 100% { transform: translateY(10px) }",
        )
    )
    return sheet


def frames() -> Sheet:
    """It turns, its beams turn with it, and the points stay on the wall."""
    sheet = _room(
        "A rover turns, and the points of its laser stay on the walls",
        "A rover stands before a wall and turns. Its axes, base_link, turn with it, and so do the"
        " beams of its laser. The points where they end stay on the wall: they are numbers in"
        " odom, whose axes stand in the corner.",
    )
    beams = "".join(
        f'<path d="M0 0L{x} {y}" stroke="{AMBER}" stroke-width="2"/>'
        for x, y in ((-55, -118), (-23, -128), (23, -128), (55, -118))
    )
    sheet.add(placed(340, 160, beams, name="beams"))
    sheet.add(f'<rect x="24" y="22" width="672" height="32" fill="{GREY}"/>')
    for x in range(250, 440, 20):
        sheet.add(f'<circle cx="{x}" cy="55" r="4" fill="{RED}"/>')
    sheet.arrow((60, 186), (130, 186), colour=GREEN)
    sheet.arrow((60, 186), (60, 116), colour=GREEN)
    sheet.text((104, 174), "odom", size=15)
    sheet.add(placed(340, 160, rover(scale=1.4), turned=-90, name="turn"))
    sheet.text((440, 186), "base_link", size=15)
    sheet.text((560, 84), "/walls", size=15)
    sheet.text((560, 130), "/odom and /scan in", size=15)
    sheet.moves(
        _moved(
            "beams",
            6,
            "0%, 100% { transform: rotate(-10deg) } 50% { transform: rotate(10deg) }",
            rests="none",
        )
        + " "
        + _moved(
            "turn",
            6,
            "0%, 100% { transform: rotate(-10deg) } 50% { transform: rotate(10deg) }",
            rests="none",
        )
    )
    return sheet


def _line(start: float, y: float, end: float) -> str:
    """The way that it goes."""
    return (
        f'<path d="M{start:g} {y:g}H{end:g}" fill="none" stroke="#3f8d86" stroke-width="3"'
        ' stroke-dasharray="3 9" stroke-linecap="round"/>'
    )


DRAWN: dict[str, Callable[[], Sheet]] = {
    "nodes": nodes,
    "topics": topics,
    "distance-sensor": distance_sensor,
    "services": services,
    "actions": actions,
    "serial-bridge": serial_bridge,
    "pi-camera": pi_camera,
    "bring-up": bring_up,
    "black-box": black_box,
    "e-stop": e_stop,
    "wander": wander,
    "frames": frames,
}
"""Lab to what draws it."""


def main(folder: Path) -> None:
    """Write all of them: FOLDER/LAB/pictures/moves.svg."""
    for name, draw in DRAWN.items():
        file = folder / name / "pictures" / "moves.svg"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(draw().svg(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
