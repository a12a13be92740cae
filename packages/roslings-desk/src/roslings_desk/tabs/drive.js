// Keys that count in the pad alone. What is held is said every 100 ms, so that a page that is gone
// says nothing: the desk then stops the robot. Escape stops it, wherever the focus is.
(() => {
  const WAYS = {
    ArrowUp: [1, 0],
    ArrowDown: [-1, 0],
    ArrowLeft: [0, 1],
    ArrowRight: [0, -1],
  };
  const pad = document.getElementById("drive-pad");
  const held = new Set();
  let beat = null;

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
  pad.addEventListener("blur", () => held.size && stop());
  document.addEventListener("visibilitychange", () => document.hidden && held.size && stop());
  document.addEventListener("keydown", (event) => event.key === "Escape" && stop());
})();
