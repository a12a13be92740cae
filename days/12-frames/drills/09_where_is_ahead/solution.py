"""A camera looks ahead, and sees a ball 2 m ahead of itself. Print where the ball is
for the rover, ahead and to the left: "ball at 2.10, 0.00"."""

from geometry_msgs.msg import PointStamped, Quaternion, TransformStamped
from tf2_geometry_msgs import do_transform_point


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
    ball.point.z = 2.0
    seen = do_transform_point(ball, camera()).point
    print(f"ball at {seen.x:.2f}, {seen.y:.2f}")


main()
