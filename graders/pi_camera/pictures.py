"""Pictures for the reader of the report: small PNGs, a few of them in an experiment."""

from __future__ import annotations

import base64
import io

import numpy as np
import numpy.typing as npt
import png

from roslings.capabilities.camera.record import CameraSeen, PictureKept
from roslings.evidence import ExperimentSeen

WIDEST = 240
LARGEST_BYTES = 64 * 1024
MOST_PICTURES = 3
FINEST = 0xF8
"""Bits of each value that are kept: noise in the others would double the file."""

Pixels = npt.NDArray[np.uint8]


def keep_picture(seen: ExperimentSeen, title: str, caption: str, rgb: Pixels) -> None:
    """Put a picture (rows, columns, red green blue) into the evidence, made small.

    Where MOST_PICTURES are there already, or it stays too large, it is left out.
    """
    if len(seen.part(CameraSeen).pictures) >= MOST_PICTURES:
        return
    small: Pixels = shrunk(rgb, WIDEST) & np.uint8(FINEST)
    content = png_of(small)
    if len(content) <= LARGEST_BYTES:
        text = base64.b64encode(content).decode("ascii")
        height, width, _ = small.shape
        kept = PictureKept(title=title, caption=caption, png=text, width=width, height=height)
        seen.recording(CameraSeen).pictures.append(kept)


def shrunk(rgb: Pixels, widest: int) -> Pixels:
    """The picture, each block of pixels made one, so that it is at most `widest` pixels wide."""
    factor = -(-max(rgb.shape[0], rgb.shape[1]) // widest)
    height, width = rgb.shape[0] // factor, rgb.shape[1] // factor
    blocks = rgb[: height * factor, : width * factor].reshape(height, factor, width, factor, 3)
    small: Pixels = blocks.mean(axis=(1, 3)).astype(np.uint8)
    return small


def png_of(rgb: Pixels) -> bytes:
    """The bytes of a PNG file."""
    height, width, _ = rgb.shape
    file = io.BytesIO()
    writer = png.Writer(width, height, greyscale=False, compression=9)
    writer.write(file, rgb.reshape(height, width * 3).tolist())
    return file.getvalue()


def draw_ring(rgb: Pixels, x_px: float, y_px: float, radius_px: float) -> None:
    """A white ring with a black rim, into the picture itself."""
    rows, columns = np.ogrid[: rgb.shape[0], : rgb.shape[1]]
    away = np.abs(np.hypot(columns - x_px, rows - y_px) - radius_px)
    rgb[away < 3.0] = 0
    rgb[away < 1.6] = 255


def draw_cross(rgb: Pixels, x_px: float, y_px: float, arm_px: float) -> None:
    """A white cross with a black rim, into the picture itself."""
    rows, columns = np.ogrid[: rgb.shape[0], : rgb.shape[1]]
    across, down = np.abs(columns - x_px), np.abs(rows - y_px)
    near, far = np.minimum(across, down), np.maximum(across, down)
    rgb[(near < 2.6) & (far < arm_px + 1.5)] = 0
    rgb[(near < 1.2) & (far < arm_px)] = 255
