// Progress of the student, kept in this browser under the stable ids of questions, labs and days.
// Nothing leaves the computer. The other scripts use what this one puts into window.roslings.
(function () {
  "use strict";

  // --- texts: English stands where it is said; a site in another language has the others by id ----

  const TEXTS = {};

  // The text of this id, its {fields} filled in.
  function text(id, english, fields = {}) {
    return (TEXTS[id] || english).replace(/\{(\w+)\}/g, (field, name) => (name in fields ? fields[name] : field));
  }

  // The form of a text that fits a number, which is the field `count` in it.
  function counted(id, count, one, other, fields = {}) {
    const form = new Intl.PluralRules(document.documentElement.lang || "en").select(count);
    const english = count === 1 ? one : other;
    return text(`${id}.${form}` in TEXTS ? `${id}.${form}` : `${id}.other`, english, { count, ...fields });
  }

  const KEY = "roslings.progress";
  const SCHEMA = 1;
  const LARGEST_FILE_BYTES = 1000000;
  // A missed question comes back after so many days; each right answer leads to the next number,
  // a wrong one to the first. After the last, it is learnt.
  const INTERVALS_DAYS = [1, 3, 7, 14, 30];
  const ID = /^[a-z0-9][a-z0-9-]*$/;
  const DATE = /^\d{4}-\d{2}-\d{2}$/;

  let inMemory = null; // where the browser keeps nothing, progress lasts as long as the page

  function empty() {
    return { roslings: "progress", schema: SCHEMA, questions: {}, days: {}, labs: {} };
  }

  // --- dates: days of the student's own calendar, as YYYY-MM-DD ---------------------------------

  function asDate(day) {
    const two = (number) => String(number).padStart(2, "0");
    return `${day.getFullYear()}-${two(day.getMonth() + 1)}-${two(day.getDate())}`;
  }

  function today() {
    return asDate(new Date());
  }

  function inDays(days) {
    const day = new Date();
    return asDate(new Date(day.getFullYear(), day.getMonth(), day.getDate() + days));
  }

  // --- reading and writing ----------------------------------------------------------------------

  function read() {
    let kept = null;
    try {
      kept = localStorage.getItem(KEY);
    } catch {
      return inMemory || empty();
    }
    if (kept === null) return inMemory || empty();
    const found = check(kept);
    if (found.progress) return found.progress;
    localStorage.setItem(`${KEY}.damaged`, kept); // nothing is thrown away
    return empty();
  }

  function write(progress) {
    inMemory = progress;
    try {
      localStorage.setItem(KEY, JSON.stringify(progress));
    } catch {
      // A private window: what is in memory must do.
    }
    document.dispatchEvent(new CustomEvent("roslings:progress"));
  }

  function change(how) {
    const progress = read();
    how(progress);
    write(progress);
  }

  // --- questions --------------------------------------------------------------------------------

  // Keep one answer. Only a question that was missed comes back.
  function answer(id, right) {
    change((progress) => {
      const before = progress.questions[id];
      progress.questions[id] = afterAnswer(before, right);
    });
  }

  function afterAnswer(before, right) {
    const tries = (before ? before.tries : 0) + 1;
    const now = { right, tries, on: today() };
    if (!right) return { ...now, step: 0, due: inDays(INTERVALS_DAYS[0]) };
    if (!before || before.due === undefined) return now;
    if (before.due > today()) return { ...now, step: before.step, due: before.due };
    const step = before.step + 1;
    return step < INTERVALS_DAYS.length ? { ...now, step, due: inDays(INTERVALS_DAYS[step]) } : now;
  }

  function isDue(question) {
    return question.due !== undefined && question.due <= today();
  }

  // Ids of missed questions: those that are due, and the date of the next that is not.
  function review() {
    const missed = Object.entries(read().questions).filter(([, each]) => each.due !== undefined);
    const later = missed.filter(([, each]) => !isDue(each)).map(([, each]) => each.due);
    return {
      missed: missed.map(([id]) => id),
      due: missed.filter(([, each]) => isDue(each)).map(([id]) => id),
      next: later.sort()[0] || null,
    };
  }

  // --- days and labs ----------------------------------------------------------------------------

  function finishDay(day) {
    change((progress) => {
      progress.days[day] = { on: today() };
    });
  }

  function passLab(lab, score) {
    change((progress) => {
      progress.labs[lab] = { score, on: today() };
    });
  }

  // What `./roslings site --open` has written at the end of this script: labs with their best
  // score, and for each day how many of its drills are done. It is shown, and never kept here.
  let yours = { labs: {}, drills: {} };

  function tell(found) {
    yours = found;
  }

  // The best known score of a lab: { score, passed }, or null where nobody knows of one.
  function scoreOf(lab) {
    const loaded = read().labs[lab];
    const measured = yours.labs[lab];
    if (loaded && !(measured && measured.score > loaded.score)) {
      return { score: loaded.score, passed: true };
    }
    return measured || null;
  }

  // How many drills of a day are done, and how many there are; null where nobody knows.
  function drillsOf(day) {
    return yours.drills[day.id] || null;
  }

  // What stands between a student and the end of a day.
  function missing(day) {
    const progress = read();
    return {
      questions: day.questions.filter((id) => !progress.questions[id]),
      labs: day.labs.filter((lab) => !(scoreOf(lab) || { passed: false }).passed),
      done: Boolean(progress.days[day.id]),
    };
  }

  // The day that a part of the page tells of, read from its attributes.
  function dayOf(element) {
    const words = (name) => (element.dataset[name] || "").split(" ").filter(Boolean);
    return { id: element.dataset.day, labs: words("labs"), questions: words("questions") };
  }

  // --- files ------------------------------------------------------------------------------------

  // Read what a progress file holds. Gives { progress } or { problem }, a sentence for the student.
  function check(content) {
    const value = parsed(content);
    if (!isRecord(value)) return { problem: text("script.file.not_json", "This file is not complete JSON.") };
    if (value.roslings !== "progress") {
      return { problem: text("script.file.other", "This is not a progress file of roslings.") };
    }
    if (value.schema !== SCHEMA) {
      const english = "This file has the form {found}. This site reads the form {ours}.";
      return { problem: text("script.file.form", english, { found: value.schema, ours: SCHEMA }) };
    }
    const kinds = { questions: isQuestion, days: isDay, labs: isLab };
    const progress = empty();
    for (const [kind, isRight] of Object.entries(kinds)) {
      const entries = Object.entries(isRecord(value[kind]) ? value[kind] : { "?": null });
      const wrong = entries.find(([id, entry]) => !ID.test(id) || !isRight(entry));
      if (wrong) {
        const english = 'This file is damaged at {kind}, "{id}".';
        return { problem: text("script.file.damaged", english, { kind, id: wrong[0].slice(0, 40) }) };
      }
      progress[kind] = Object.fromEntries(entries);
    }
    return { progress };
  }

  function parsed(content) {
    if (content.length > LARGEST_FILE_BYTES) return null;
    try {
      return JSON.parse(content);
    } catch {
      return null;
    }
  }

  function isRecord(value) {
    return typeof value === "object" && value !== null && !Array.isArray(value);
  }

  function isDay(entry) {
    return isRecord(entry) && DATE.test(entry.on);
  }

  function isLab(entry) {
    return isDay(entry) && Number.isFinite(entry.score) && entry.score >= 0 && entry.score <= 100;
  }

  function isQuestion(entry) {
    if (!isDay(entry) || typeof entry.right !== "boolean" || !Number.isInteger(entry.tries)) return false;
    if (entry.due === undefined) return true;
    return DATE.test(entry.due) && INTERVALS_DAYS[entry.step] !== undefined;
  }

  // Take over a file. What is newer wins, so two computers can be joined.
  function join(other) {
    change((progress) => {
      for (const kind of ["questions", "days", "labs"]) {
        for (const [id, entry] of Object.entries(other[kind])) {
          const mine = progress[kind][id];
          if (!mine || mine.on <= entry.on) progress[kind][id] = entry;
        }
      }
    });
  }

  // Read a verdict of `./roslings check LAB --json FILE`. Gives { lab, outcome, score } or { problem }.
  function readVerdict(content) {
    const value = parsed(content);
    const isVerdict =
      isRecord(value) && value.schema === 1 && typeof value.lab === "string" && ID.test(value.lab) &&
      ["pass", "fail", "inconclusive"].includes(value.outcome) && Array.isArray(value.checks);
    if (!isVerdict) {
      const english = "This is not a verdict of roslings. Write one with the command above.";
      return { problem: text("script.verdict.none", english) };
    }
    return { lab: value.lab, outcome: value.outcome, score: Number(value.score) || 0 };
  }

  function save(name, content, type) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([content], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  function forget() {
    write(empty());
  }

  window.roslings = {
    text, counted, read, answer, review, finishDay, passLab, missing, tell, scoreOf, drillsOf, dayOf, check, join, readVerdict, save, forget,
    today, INTERVALS_DAYS,
  };
})();
