"""`python -m ros2_on_pip`, for those who work on it; students have `ros2` on their path."""

from ros2_on_pip.cli import begin

if __name__ == "__main__":
    begin()
