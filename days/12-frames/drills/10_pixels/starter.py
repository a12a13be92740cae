"""A ball is in column 480 of a picture that is 640 wide, and 2 m ahead of the camera.
Print where it is for the rover, ahead and to the left: "ball at 2.10, -1.00"."""

from geometry_msgs.msg import PointStamped, Quaternion, TransformStamped
from tf2_geometry_msgs import do_transform_point

COLUMN, MIDDLE, FOCAL_PX = 480, 320, 320
AHEAD_M = 2.0


def camera():
    """Where the camera is on the rover: its z looks ahead, its x right, its y down."""
    mount = TransformStamped(child_frame_id="camera_optical")
    mount.header.frame_id = "base_link"
    mount.transform.translation.x = 0.10
    mount.transform.rotation = Quaternion(x=-0.5, y=0.5, z=-0.5, w=0.5)
    return mount


def main():
    ball = PointStamped()
    ball.header.frame_id = "camera_optical"
    ball.point.z = AHEAD_M
    ball.point.x = float(COLUMN)
    seen = do_transform_point(ball, camera()).point
    print(f"ball at {seen.x:.2f}, {seen.y:.2f}")


main()
