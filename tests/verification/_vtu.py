"""Reads the nodes of a VTU file as the program writes it: zlib-compressed, base64."""

import base64
import re
import struct
import zlib

TYPES = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}


def decode(kind, text):
    """A compressed data array: a header of (blocks, size, last size, compressed sizes ...), then the blocks."""
    n_blocks = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    header_chars = 4 * ((4 * (3 + n_blocks) + 2) // 3)
    sizes = struct.unpack(f"<{n_blocks}I", base64.b64decode(text[:header_chars])[12:12 + 4 * n_blocks])
    blocks, begin, data = base64.b64decode(text[header_chars:]), 0, b""
    for size in sizes:
        data += zlib.decompress(blocks[begin:begin + size])
        begin += size
    return struct.unpack(f"<{len(data) // struct.calcsize(TYPES[kind])}{TYPES[kind]}", data)


def read_nodes(file_name):
    """Each node once, as {"position": (x, y, z), field name: value or (x, y, z)}, in no particular order."""
    with open(file_name, encoding="utf-8") as file:
        text = file.read()
    fields = {}
    for attributes, content in re.findall(r"<DataArray([^>]*)>([^<]*)</DataArray>", text):
        attributes = dict(re.findall(r'(\w+)="([^"]*)"', attributes))
        if attributes["format"] != "binary" or attributes.get("Name") in ("connectivity", "offsets", "types"):
            continue
        values, n = decode(attributes["type"], "".join(content.split())), int(attributes.get("NumberOfComponents", 1))
        fields[attributes.get("Name", "position")] = (
            values if n == 1 else [values[i:i + n] for i in range(0, len(values), n)])
    nodes = {position: {name: values[i] for name, values in fields.items()}
             for i, position in enumerate(fields["position"])}
    return list(nodes.values())
