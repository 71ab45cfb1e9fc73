"""What a file may unpack to, and that it is all there: a small one can stand for more memory than there is, or point
at other files of this machine, whose bytes would become samples."""

from __future__ import annotations

import struct
import zipfile
import zlib
from pathlib import Path

from symid.errors import RecordingError
from symid.files import MOST_BYTES

PIECE = 2**16
"""Bytes that are unpacked at once: at most a thousand times as many come out."""


def refuse_huge(path: Path, size: int) -> None:
    """RecordingError where the content has more than `MOST_BYTES`."""
    if size > MOST_BYTES:
        raise RecordingError(
            f"{path}: unpacks to {size / 1e9:.1f} GB or more, and {MOST_BYTES / 1e9:.1f} GB are the most that is read; "
            "write shorter recordings, or fewer columns"
        )


def refuse_huge_zip(path: Path) -> None:
    """Of a workbook, which is a zip file; Python reads no more of a member than its directory says."""
    with zipfile.ZipFile(path) as archive:
        refuse_huge(path, sum(member.file_size for member in archive.infolist()))


def refuse_huge_mat(path: Path) -> None:
    """Of a MATLAB file of version 5 to 7: its packed variables are unpacked for their sizes, and not kept."""
    with open(path, "rb") as file:
        order = "<" if file.read(128)[126:] == b"IM" else ">"
        total = 0
        while len(tag := file.read(8)) == 8:
            kind, length = struct.unpack(f"{order}II", tag)
            if kind != 15:  # miCOMPRESSED
                file.seek(length, 1)
                continue
            unpacked, end = zlib.decompressobj(), file.tell() + length
            while piece := file.read(min(PIECE, end - file.tell())):
                total += len(unpacked.decompress(piece))
                refuse_huge(path, total)


def refuse_elsewhere(path: Path, file) -> None:
    """Of an open HDF5 file: links, virtual datasets and external storage lead to other files; sizes are only stated."""
    import h5py

    link = file.visititems_links(lambda name, link: (name, link) if isinstance(link, h5py.ExternalLink) else None)
    if link is not None:
        raise RecordingError(
            f"{path}: '{link[0]}' is a link to the file {link[1].filename}; put its data into this one"
        )
    nodes: list = []
    file.visititems(lambda name, node: nodes.append(node))
    data = [node for node in nodes if isinstance(node, h5py.Dataset)]
    for node in data:
        if node.external or node.is_virtual:
            raise RecordingError(f"{path}: the values of '{node.name}' are in other files; put them into this one")
    refuse_huge(path, sum(node.nbytes for node in data))
