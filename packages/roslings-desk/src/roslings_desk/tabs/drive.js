// Keys and a gamepad that count while the pad has the focus. What is held is said every 100 ms, so
// that a page that is gone says nothing: the desk then stops the robot. Escape stops it, wherever the
// focus is. The gamepad's left stick drives, as https://www.w3.org/TR/gamepad/ numbers its axes.
(() => {
  const WAYS = {
    ArrowUp: [1, 0],
    ArrowDown: [-1, 0],
    ArrowLeft: [0, 1],
    ArrowRight: [0, -1],
  };
  const STILL = 0.15; // a stick that is let go is rarely at zero
  const STOP_BUTTON = 0;
  const pad = document.getElementById("drive-pad");
  const held = new Set();
  let beat = null;
  let stickMoves = false;
  let stickIsStopped = false; // until it is let go once

  function say() {
    const ways = [...held].map((key) => WAYS[key]);
    const sum = (part) => ways.reduce((all, way) => all + way[part], 0);
    emitEvent("desk-drive", [sum(0), sum(1)]);
  }

  function rest() {
    clearInterval(beat);
    beat = null;
    held.clear();
  }

  function stop() {
    rest();
    stickIsStopped = true;
    emitEvent("desk-stop");
  }

  pad.addEventListener("keydown", (event) => {
    const plain = !(event.ctrlKey || event.altKey || event.metaKey);
    if (event.key === " ") {
      event.preventDefault();
      stop();
    } else if (plain && event.key in WAYS) {
      event.preventDefault();
      if (!held.has(event.key)) {
        held.add(event.key);
        say();
      }
      beat = beat ?? setInterval(say, 100);
    }
  });
  pad.addEventListener("keyup", (event) => {
    if (!held.delete(event.key)) return;
    held.size ? say() : stop();
  });

  function followStick() {
    const gamepad = navigator.getGamepads().find((each) => each?.connected);
    if (!gamepad || document.activeElement !== pad || document.hidden) {
      leaveStick();
      return;
    }
    const [left, ahead] = [-gamepad.axes[0], -gamepad.axes[1]];
    const isHeld = Math.hypot(left, ahead) > STILL;
    stickIsStopped = stickIsStopped && isHeld;
    if (gamepad.buttons[STOP_BUTTON]?.pressed) {
      stop();
    } else if (isHeld && !stickIsStopped) {
      stickMoves = true;
      emitEvent("desk-drive", [ahead, left]);
    } else {
      leaveStick();
      stickIsStopped = isHeld;
    }
  }

  function leaveStick() {
    if (!stickMoves) return;
    stickMoves = false;
    stop();
  }

  setInterval(followStick, 100);
  pad.addEventListener("blur", () => held.size && stop());
  document.addEventListener("visibilitychange", () => document.hidden && held.size && stop());
  document.addEventListener("keydown", (event) => event.key === "Escape" && stop());
})();
