"""Reads the arrays of a .vtp file that Blum wrote. Python's standard library alone."""

import base64
import struct
import xml.etree.ElementTree as tree

FORMATS = {"Float64": "d", "Int64": "q", "UInt64": "Q", "Int32": "i", "UInt32": "I", "UInt8": "B"}


def arrays(path):
    """{"CellData/sheet": [...], "Points/Points": [...], ...}"""
    result = {}
    for parent in tree.parse(path).iter():
        for node in parent.findall("DataArray"):
            data = base64.b64decode(node.text)
            (length,) = struct.unpack_from("=Q", data)
            kind = FORMATS[node.get("type")]
            values = struct.unpack(f"={length // struct.calcsize('=' + kind)}{kind}", data[8:])
            result[f"{parent.tag}/{node.get('Name')}"] = list(values)
    return result
