"""The line above each tab of a desk that plays a bag: stand, go on, another place."""

from __future__ import annotations

import time

from nicegui import ui

from roslings_desk.bag_player import BagPlayer
from roslings_desk.controls import PageText, Slider, button, part

EVERY_S = 0.25
STEP_S = 0.1
LEFT_ALONE_S = 1.5
"""The slider follows the bag only where nobody has moved it for so long."""


class BagBar:
    """Made inside of a page; it follows the bag until the page is gone."""

    def __init__(self, player: BagPlayer) -> None:
        self._player = player
        self._moved_s = 0.0
        with part("div", "bag", role="group", aria_label="The bag"):
            self._pause = button("", self._turn)
            self._place = Slider("Place in the bag, s", 0.0, 0.0, player.duration_s, STEP_S)
            self._said = PageText("p", "", "value")
        if player.left_out:
            there = ", ".join(player.left_out)
            PageText("p", f"Not played, since their types are not installed: {there}", "hint")
        self._trouble = PageText("p", "", "notice", role="alert")
        self._place.on_change(self._jump)
        self._follow()
        ui.timer(EVERY_S, self._follow)

    def _turn(self) -> None:
        self._player.pause(not self._player.is_paused)
        self._follow()

    def _jump(self) -> None:
        self._moved_s = time.monotonic()
        self._player.jump(float(self._place.value))

    def _follow(self) -> None:
        position_s = self._player.position_s
        self._pause.say("Go on" if self._player.is_paused else "Pause")
        self._said.say(f"{position_s:.1f} s of {self._player.duration_s:.1f} s")
        self._trouble.say(self._player.trouble)
        is_left_alone = time.monotonic() - self._moved_s > LEFT_ALONE_S
        if is_left_alone and abs(position_s - float(self._place.value)) >= STEP_S:
            self._place.put(round(position_s, 1))
