"""What a cell shows: pictures with words, errors in a line or two, programs, verdicts, quizzes."""

from __future__ import annotations

import base64
import html
import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

from kernels import Kernel

from skips import needs
from sources import python_path, sources


def alt_of(shown: dict[str, str]) -> str:
    """The text alternative, the same for eyes and for terminals."""
    found = re.search(r' alt="([^"]+)"', shown["text/html"])
    assert found, shown["text/html"][:200]
    return html.unescape(found[1])


def content_of(shown: dict[str, str]) -> bytes:
    """The picture itself."""
    found = re.search(r' src="data:[^,]+;base64,([^"]+)"', shown["text/html"])
    assert found
    return base64.b64decode(found[1])


def test_the_graph_is_a_picture_with_words(cells: Kernel) -> None:
    """A drawing of its own, on a white sheet, light."""
    ran = cells.run("with session() as ros:\n    ros.start(Talker)\n    show_graph()")
    (shown,) = ran.shown
    assert "/talker publishes on /words" in alt_of(shown)
    drawing = ElementTree.fromstring(content_of(shown))
    assert drawing.tag == "{http://www.w3.org/2000/svg}svg"
    assert "/talker" in "".join(drawing.itertext())
    assert "background:#fff" in shown["text/html"] and len(shown["text/html"]) < 50_000


def test_an_empty_graph_says_so(cells: Kernel) -> None:
    """Outside of a session, with nothing there."""
    (shown,) = cells.run("show_graph()").shown
    assert "no node was seen" in alt_of(shown)


def test_intervals_of_messages_and_of_a_topic(cells: Kernel) -> None:
    """Stamps that were collected, or a topic's name."""
    ran = cells.run("""
with session() as ros:
    ros.start(Talker)
    plot_intervals(ros.collect("/words", count=5, stamps=True))
    plot_intervals("/words", count=4)
""")
    assert ran.error == "", ran
    assert "4 periods" in alt_of(ran.shown[0]) and "3 periods of /words" in alt_of(ran.shown[1])


ON_THE_SITE = """
import os
class Steady(Node):
    def __init__(self):
        super().__init__("steady")
        self.publisher = self.create_publisher(String, "even", 10)
        self.timer = self.create_timer(0.2, self.tell)
    def tell(self):
        self.publisher.publish(String(data="x"))
class Sleepy(Steady):
    def tell(self):
        super().tell()
        import time
        time.sleep(0.3)
os.environ["ROSLINGS_SITE"] = "1"
try:
    for kind in (Steady, Sleepy):
        with session() as ros:
            ros.start(kind)
            plot_intervals("/even", count=6)
            print(len(ros.collect("/even", count=2)), "more")
finally:
    del os.environ["ROSLINGS_SITE"]
"""


def test_on_the_site_a_timer_is_plotted_in_simulated_time(cells: Kernel) -> None:
    """A busy computer is not in it; a callback that sleeps is slow by itself, and shown so."""
    ran = cells.run(ON_THE_SITE)
    assert ran.error == "", ran
    assert ran.text.count("2 more") == 2, "the nodes live by the wall's clock again"
    even, slow = map(alt_of, ran.shown)
    assert "the shortest 200.0 ms, the longest 200.0 ms" in even
    assert b"simulated seconds" in content_of(ran.shown[0])
    assert b"simulated seconds" not in content_of(ran.shown[1])
    shortest = re.search(r"the shortest ([\d.]+) ms", slow)
    assert shortest and float(shortest[1]) > 250


def test_intervals_need_stamps_and_two_messages(cells: Kernel) -> None:
    """Each says how to get them."""
    assert "stamps=True" in cells.run("plot_intervals([String()])").said
    assert "too few" in cells.run("plot_intervals([])").said


def test_messages_are_shown_as_they_come(cells: Kernel) -> None:
    """Each in one piece; a session is opened where there is none."""
    ran = cells.run(
        "with session() as ros:\n    ros.start(Talker)\n    watch_topic('/words', count=2)"
    )
    assert re.search(
        r"  1    0\.000 s  data: hi \d+\n  2    0\.\d{3} s  data: hi \d+\n", ran.text
    ), ran
    assert cells.run("watch_topic('/words', count=1, timeout_s=0.2)").error == "NothingHeard"


def test_the_rover_drives_on_its_map(cells: Kernel) -> None:
    """Map, path and camera, each with its words."""
    ran = cells.run("""
from geometry_msgs.msg import Twist
go = Twist()
go.linear.x = 0.3
with session() as ros:
    rover = ros.rover()
    ros.say("/cmd_vel", go)
    ros.until(lambda: rover.pose.x_m > 0.02, "the rover to move")
    show_map(rover)
    show_path(ros.collect("/odom", count=5))
    show_image(ros.collect("/camera/image_raw", count=1)[0])
""")
    assert ran.error == "", ran
    words = [alt_of(shown) for shown in ran.shown]
    assert "It is at x 0." in words[0] and "A drive on the rover's map" in words[1]
    assert "640 by 480 pixels, encoding rgb8" in words[2]
    drawn = [content_of(shown) for shown in ran.shown]
    assert b"@keyframes drive" in drawn[0] and b"@keyframes drive" in drawn[1]
    assert drawn[2].startswith(b"\x89PNG")


def test_scans_are_drawn_twice_and_a_map_once(cells: Kernel) -> None:
    """By their own numbers, and from where they were measured: a beam ahead is then on the left."""
    ran = cells.run("""
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan

scan = LaserScan(angle_increment=1.0, range_min=0.1, range_max=6.0)
scan.ranges = [2.0, float("inf"), float("nan"), 7.0]
place = TransformStamped()
place.header.frame_id = "odom"
place.transform.translation.x = 1.0
place.transform.rotation.z = place.transform.rotation.w = 0.5**0.5
show_scans([scan])
show_scans([scan, scan], [place, place])
grid = OccupancyGrid(data=[100, 0, -1, -1, 0, 60])
grid.info.width, grid.info.height, grid.info.resolution = 3, 2, 0.05
show_grid(grid)
""")
    assert ran.error == "", ran
    alone, twice, cells_of_map = map(alt_of, ran.shown)
    assert alone.endswith("By the laser's numbers alone: x from 2.0 to 2.0, y from 0.0 to 0.0.")
    assert twice.startswith("The points of 2 scans from above, in metres.")
    assert "In the frame odom: x from 1.0 to 1.0, y from 2.0 to 2.0." in twice
    assert "2 rows and 3 columns: 2 cells are occupied, 2 free and 2 unknown" in cells_of_map
    assert all(content_of(shown).startswith(b"\x89PNG") for shown in ran.shown)


def test_what_cannot_be_drawn_is_told(cells: Kernel) -> None:
    """No scan, a place too few, a map with too few cells, a scan that has seen nothing."""
    cells.run("from nav_msgs.msg import OccupancyGrid\nfrom sensor_msgs.msg import LaserScan")
    assert "There is no scan" in cells.run("show_scans([])").said
    assert "2 scans need 2 places" in cells.run("show_scans([LaserScan()] * 2, [1])").said
    assert "it has 0" in cells.run("show_grid(OccupancyGrid())").said
    assert "nothing is seen" in alt_of(cells.run("show_scans([LaserScan()])").shown[0])


@needs("module tf2_msgs")
def test_a_rovers_odometry_may_drift(cells: Kernel) -> None:
    """Its pose stays the truth, and its frames say what leads there."""
    ran = cells.run("""
from geometry_msgs.msg import Twist
go = Twist()
go.linear.x = 0.3
with session() as ros:
    rover = ros.rover(drift_percent=50.0, map_frame=True)
    ros.say("/cmd_vel", go)
    ros.until(lambda: rover.pose.x_m > 0.1, "the rover to move")
    print(rover.odom_pose.x_m > 1.2 * rover.pose.x_m, rover.publishes_tf)
    for topic in ("/tf", "/tf_static"):
        (told,) = ros.collect(topic, count=1)
        print(*(f"{t.header.frame_id}>{t.child_frame_id}" for t in told.transforms))
with session() as ros:
    print(ros.rover(tf=False).publishes_tf)
""")
    assert ran.error == "", ran
    moving, fixed = "map>odom odom>base_link", "base_link>laser base_link>camera_optical"
    assert ran.text.splitlines() == ["True True", moving, fixed, "False"], ran


def test_a_cells_rover_is_the_only_one_in_its_domain(cells: Kernel) -> None:
    """Beside the rover of a terminal it does not start, and says what to do."""
    cells.run("from roslings_rover.rover.one_rover import rover_of_terminal")
    there = cells.run("with session() as ros, rover_of_terminal():\n    ros.rover()")
    assert there.error == "RoverThere" and "End the other one: with Ctrl-C" in there.told
    assert len(there.trace) == 2
    alone = cells.run("with session() as ros:\n    ros.rover()")
    assert alone.error == ""


IMAGE = """
from sensor_msgs.msg import Image
image = Image(width=2, height=1, encoding="bgr8", step=8, data=bytes([255, 0, 0, 0, 0, 255, 9, 9]))
"""


def test_a_picture_with_filled_rows_and_blue_first(cells: Kernel) -> None:
    """What fills up a row is no pixel; bgr8 begins with blue."""
    import io

    import png

    (shown,) = cells.run(IMAGE + "show_image(image)").shown
    width, height, rows, _ = png.Reader(io.BytesIO(content_of(shown))).read()
    assert (width, height) == (2, 1)
    assert [list(row) for row in rows] == [[0, 0, 255, 255, 0, 0]]
    assert "R 255, G 0, B 0" in alt_of(shown)


def test_a_picture_that_does_not_fit_says_what_would(cells: Kernel) -> None:
    """Sizes, encodings, and things that are no pictures."""
    assert "need step 9" in cells.run(IMAGE + "image.width = 3\nshow_image(image)").said
    assert "rgb8" in cells.run(IMAGE + "image.encoding = 'yuv'\nshow_image(image)").said
    assert "is no picture" in cells.run("show_image(String())").said
    assert "no place" in cells.run("show_path([])").said


def test_an_assert_is_told_in_a_line(cells: Kernel) -> None:
    """And is an error all the same."""
    ran = cells.run("assert 1 == 2, 'Still 1: make it 2.'")
    assert ran.error == "AssertionError" and ran.told == "Not yet: Still 1: make it 2."
    assert cells.run("x = 1\nassert x == 2").told == "Not yet: this is not true: x == 2"


def test_other_errors_end_in_the_students_line(cells: Kernel) -> None:
    """No line of a library."""
    ran = cells.run("import json\n\ndef read():\n    return json.loads('{')\n\nread()")
    assert ran.error == "JSONDecodeError"
    assert "Line 4 of the cell, in read" in ran.told and "decoder.py" not in ran.told


def test_a_syntax_error_stays_as_python_shows_it(cells: Kernel) -> None:
    """With the arrow below the place."""
    ran = cells.run("print('a'")
    assert ran.error == "SyntaxError" and "^" in ran.told


def test_a_terminals_command_is_printed(cells: Kernel) -> None:
    """With its exit code where it is not 0, and an end where it has none."""
    assert cells.run("terminal('echo one; echo two >&2')").text == "one\ntwo\n"
    assert "(exit code 3)" in cells.run("terminal('exit 3')").text
    assert "does not end by itself" in cells.run("terminal('sleep 100', timeout_s=0.3)").text


def test_a_program_speaks_and_ends_by_ctrl_c(cells: Kernel, tmp_path: Path) -> None:
    """Its lines come at once, and Ctrl-C reaches Python code."""
    script = tmp_path / "ticks.py"
    script.write_text(
        "import sys, time\n"
        "print('begun')\n"
        "try:\n    time.sleep(1000)\n"
        "except KeyboardInterrupt:\n    print('bye'); sys.exit(7)\n"
    )
    ran = cells.run(f"""
with session() as ros:
    program = ros.run("{sys.executable} -S {script}")
    print(program.says("egu"), program.runs, program.stop(), program.lines, program.runs)
""")
    assert "begun True 7 ['begun', 'bye'] False" in ran.text, ran


def test_a_program_that_never_says_it(cells: Kernel) -> None:
    """One that ended, and one that goes on."""
    begin = "with session() as ros:\n    ros.run"
    ran = cells.run(begin + "('echo no; exit 2').says('yes')")
    assert ran.error == "ProgramEnded" and "exit code 2" in ran.said and "\nno" in ran.said
    ran = cells.run(begin + "('sleep 100').says('yes', timeout_s=0.2)")
    assert ran.error == "NeverSaid" and "(nothing)" in ran.said


def test_a_check_of_nothing_says_how_to_begin(cells: Kernel) -> None:
    """No error, one line."""
    ran = cells.run("check('topics')\ncheck('tropics')")
    first, second = ran.text.splitlines()[:2]
    assert first.endswith("./roslings start topics") and "tropics" in second
    assert ran.error == ""


def test_a_kernel_without_ros_is_told_in_a_line() -> None:
    """Python alone, with nothing installed: the first import says what to do."""
    source = (
        f"import sys; sys.path[:0] = {list(map(str, sources()))!r}; import roslings_learn.notebook"
    )
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", source],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    last = done.stderr.splitlines()[-1]
    assert "NoRos" in last and "./roslings lab" in last


def test_importing_is_quiet_outside_of_notebooks() -> None:
    """A program that imports it gets no IPython."""
    source = "import roslings_learn.notebook, sys; print('IPython' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", source],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": python_path()},
    )
    assert done.stdout.strip() == "False"


def test_the_desk_of_a_window_stands_below_the_cell(cells: Kernel) -> None:
    """In the domain of this notebook, behind the server's own address."""
    ran = cells.run("""
import os
from roslings_learn.notebook import desk
os.environ["ROSLINGS_WINDOW"] = "/user/ann/"
with session() as ros:
    print(ros.context.get_domain_id())
desk("graph")
del os.environ["ROSLINGS_WINDOW"]
""")
    assert ran.error == "", ran
    (shown,) = ran.shown
    assert f'src="/user/ann/roslings/desk/{ran.text.strip()}/graph"' in shown["text/html"]
    wrong = cells.run("desk('plott')")
    assert wrong.error == "NoSuchTab" and "It has: rover, graph, topics, frames, plot" in wrong.told


def test_elsewhere_the_desk_is_a_program_beside_the_cell(cells: Kernel) -> None:
    """It says where its page is. The next one takes its place, and it ends with the kernel."""
    ran = cells.run("os.environ['BROWSER'] = 'true'\ndesk()\ndesk('plot')")
    assert ran.error == "", ran
    assert ran.text.count("The desk is open. Its page, for a browser of yours: file://") == 2
    there = cells.run("""
import psutil
words = [child.cmdline() for child in psutil.Process().children(recursive=True)]
print(sorted(each[-1] for each in words if "desk" in each))
""")
    assert there.text.strip() == "['plot']"
