"""The camera: what the rover sees now, under a light that can be set."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
import numpy.typing as npt

from roslings_rover.camera.frame import Encoding, Frame, Pixels, frame_of
from roslings_rover.camera.scene import HUES, draw
from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.pinhole import Disc, PinholeCameraModel
from roslings_rover.models.world import World

NEUTRAL_BRIGHTNESS = 50
LEVELS_A_POINT = 2.55
NOISE_BANK = 1 << 21
"""Values; a picture of 640 by 480 takes 0.9 million of them."""


@dataclass(frozen=True)
class Light:
    """How a picture looks. Raises ValueError for what no camera has."""

    brightness: int = NEUTRAL_BRIGHTNESS
    """0 to 100; each point adds 2.55 of 255 levels to every value, as far as it goes."""
    ball_hue: int | None = None
    """All balls in this colour, 0 to 179 as OpenCV counts; None leaves each its own."""
    noise: float = 2.0
    """Standard deviation of each value, in levels of 255."""

    def __post_init__(self) -> None:
        if not 0 <= self.brightness <= 100:
            raise ValueError(f"brightness is 0 to 100, not {self.brightness}")
        if self.ball_hue is not None and not 0 <= self.ball_hue < HUES:
            raise ValueError(f"a hue is 0 to {HUES - 1}, not {self.ball_hue}")
        if not self.noise >= 0:
            raise ValueError(f"noise is 0 or more, not {self.noise}")


class CameraMount(Protocol):
    """What a camera can be mounted on: a rover."""

    @property
    def world(self) -> World:
        """What stands around it."""
        ...

    @property
    def pose(self) -> Pose:
        """Where it is."""
        ...


class SyntheticCamera:
    """Draws frames; the same seed draws the same noise. `light` may change between frames."""

    def __init__(
        self,
        camera_model: PinholeCameraModel = PinholeCameraModel(),  # noqa: B008 - cannot change
        light: Light = Light(),
        encoding: Encoding = "rgb8",
        idle_bytes: int = 0,
        seed: int = 0,
    ) -> None:
        self.camera_model, self.light = camera_model, light
        self.encoding, self.idle_bytes = encoding, idle_bytes
        self._chance = np.random.default_rng(seed)
        self._bank = self._chance.standard_normal(NOISE_BANK).astype(np.float32)
        self._grain: tuple[float, npt.NDArray[np.int16]] | None = None

    def look(self, rover: CameraMount) -> Frame:
        """What the rover sees now."""
        return self.frame(self.camera_model.see(rover.world, rover.pose))

    def frame(self, discs: Iterable[Disc]) -> Frame:
        """A picture of balls at chosen places."""
        shown = [self._coloured(disc) for disc in discs]
        picture = self._lit(draw(shown, self.camera_model.width_px, self.camera_model.height_px))
        return frame_of(picture, self.encoding, self.idle_bytes)

    def _coloured(self, disc: Disc) -> Disc:
        return disc if self.light.ball_hue is None else replace(disc, hue=self.light.ball_hue)

    def _lit(self, picture: Pixels) -> Pixels:
        brighter = round((self.light.brightness - NEUTRAL_BRIGHTNESS) * LEVELS_A_POINT)
        if not brighter and not self.light.noise:
            return picture
        values = picture.astype(np.int16) + np.int16(brighter)
        if self.light.noise:
            values += self._noise(values.size).reshape(values.shape)
        lit: Pixels = np.clip(values, 0, 255).astype(np.uint8)
        return lit

    def _noise(self, count: int) -> npt.NDArray[np.int16]:
        """From a bank that is entered at a random place: a tenth of the time of fresh noise."""
        level = self.light.noise
        if self._grain is None or self._grain[0] != level:
            self._grain = (level, np.rint(self._bank * level).astype(np.int16))
        start = int(self._chance.integers(NOISE_BANK // 2))
        grain: npt.NDArray[np.int16] = self._grain[1][start : start + count]
        return grain if grain.size == count else np.resize(self._grain[1][start:], count)
