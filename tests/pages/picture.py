"""Reads PNG files of eight bits a channel, RGB or RGBA, without a library: what the page shows is held against the file."""

import struct
import zlib


def read_png(path):
    """Columns, lines, and a function that gives the levels (R, G, B) of a pixel."""
    with open(path, "rb") as file:
        data = file.read()
    position, compressed = 8, b""
    while position < len(data):
        (length,) = struct.unpack(">I", data[position:position + 4])
        kind, content = data[position + 4:position + 8], data[position + 8:position + 8 + length]
        if kind == b"IHDR":
            columns, lines, depth, colour = struct.unpack(">IIBB", content[:10])
            assert depth == 8 and colour in (2, 6), "a PNG of another kind"
        elif kind == b"IDAT":
            compressed += content
        position += 12 + length
    channels = 3 if colour == 2 else 4
    raw, stride = zlib.decompress(compressed), columns * channels
    rows, above = [], bytearray(stride)
    for line in range(lines):
        begin = line * (stride + 1)
        above = _unfiltered(raw[begin], bytearray(raw[begin + 1:begin + 1 + stride]), above, channels)
        rows.append(above)
    return columns, lines, lambda x, y: list(rows[y][channels * x:channels * x + 3])


def _unfiltered(kind, row, above, step):
    for i in range(len(row)):
        left, up, corner = (row[i - step] if i >= step else 0), above[i], (above[i - step] if i >= step else 0)
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + up) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + up) // 2) & 255
        elif kind == 4:
            distances = [(abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner)]
            row[i] = (row[i] + min(distances)[2]) & 255
    return row
