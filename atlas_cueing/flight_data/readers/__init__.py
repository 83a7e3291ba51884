"""One reader for each format; what decodes it is loaded when a file of it is read."""

from ..flight_map import Format
from ..samples import Reader
from .csv import read_csv
from .dataflash import read_dataflash
from .ros_bag import read_ros_bag
from .ulog import read_ulog

READERS: dict[Format, Reader] = {
    "csv": read_csv,
    "ros": read_ros_bag,
    "ulog": read_ulog,
    "dataflash": read_dataflash,
}

__all__ = ["READERS"]
