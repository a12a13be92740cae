"""A reader of a diver's bag. It must find the greatest depth and print it,
here: the deepest was 4.5"""

from tempfile import mkdtemp

from rclpy.serialization import deserialize_message, serialize_message
from rosbag2_py import ConverterOptions, SequentialReader, SequentialWriter
from rosbag2_py import StorageOptions, TopicMetadata
from std_msgs.msg import Float32

WHERE = StorageOptions(uri=f"{mkdtemp()}/dive", storage_id="mcap")


def write_bag():
    writer = SequentialWriter()
    writer.open(WHERE, ConverterOptions("cdr", "cdr"))
    writer.create_topic(TopicMetadata(
        id=0, name="/depth", type="std_msgs/msg/Float32", serialization_format="cdr",
    ))
    for second, depth in enumerate((1.0, 4.5, 2.0)):
        writer.write("/depth", serialize_message(Float32(data=depth)), second * 10**9)
    writer.close()


def deepest():
    reader = SequentialReader()
    reader.open(WHERE, ConverterOptions("cdr", "cdr"))
    depths = []
    while reader.has_next():
        topic, raw, time_ns = reader.read_next()
        depths.append(deserialize_message(raw, Float32).data)
    return max(depths)


write_bag()
print("the deepest was", deepest())
