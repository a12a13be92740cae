// JupyterLab's part of the day's window: the desk and the page of a check are tabs beside the lesson.
//
// It is what webpack would make of an extension, written by hand, so that nothing has to be built:
// a container of "module federation". `init` gets JupyterLab's own modules, `get` gives the plugin.
(() => {
  const NAME = "roslings-window";
  const VIEWS = "roslings-view";
  const SHOW = "roslings:show";
  const OPENED = "roslings-window:file"; // in the workspace: which file was opened by itself
  const LOOK_EVERY_MS = 1000;
  const TABS = {
    rover: { title: "Rover", url: "roslings/desk/here/rover" },
    check: { title: "Check", url: "roslings/check" },
  };
  let shared = {};

  async function load(name) {
    const [version] = Object.values(shared[name]);
    return (await version.get())();
  }

  async function plugin() {
    const { ILayoutRestorer } = await load("@jupyterlab/application");
    const { MainAreaWidget, WidgetTracker } = await load("@jupyterlab/apputils");
    const { PageConfig } = await load("@jupyterlab/coreutils");
    const { ServerConnection } = await load("@jupyterlab/services");
    const { IStateDB } = await load("@jupyterlab/statedb");
    const { IFrame } = await load("@jupyterlab/ui-components");
    const base = PageConfig.getBaseUrl();

    function tab(name) {
      const content = new IFrame({
        sandbox: ["allow-same-origin", "allow-scripts", "allow-forms"],
      });
      const frame = content.node.querySelector("iframe");
      frame.title = TABS[name].title;
      content.url = base + TABS[name].url;
      content.title.label = TABS[name].title;
      const widget = new MainAreaWidget({ content });
      widget.id = `${NAME}-${name}`;
      widget.toolbar.hide();
      return widget;
    }

    function activate(app, restorer, state) {
      const tracker = new WidgetTracker({ namespace: VIEWS });
      const open = (name) => tracker.find((each) => each.id === `${NAME}-${name}`);

      // What somebody types into is not covered: then its tab stands beside, and waits.
      function comeToFront(widget) {
        const bars = [...(widget.parent?.tabBars?.() ?? [])];
        const bar = bars.find((each) => each.titles.includes(widget.title));
        const front = bar?.currentTitle?.owner;
        if (front?.node.contains(document.activeElement)) return;
        widget.parent?.selectWidget?.(widget);
      }

      // In front of the other tabs of its place, and the keyboard stays where it is.
      function show(name) {
        let widget = open(name);
        if (!widget) {
          widget = tab(name);
          void tracker.add(widget);
          const beside = Object.keys(TABS).map(open).find((each) => each?.isAttached);
          const where = beside
            ? { mode: "tab-after", ref: beside.id }
            : { mode: "split-right" };
          app.shell.add(widget, "main", { ...where, activate: false });
        }
        comeToFront(widget);
        return widget;
      }

      app.commands.addCommand(SHOW, {
        label: ({ name }) => `Show: ${TABS[name]?.title ?? "a tab of roslings"}`,
        execute: ({ name }) => (name in TABS ? show(name) : undefined),
      });
      void restorer.restore(tracker, {
        command: SHOW,
        args: (widget) => ({ name: widget.id.slice(NAME.length + 1) }),
        name: (widget) => widget.id.slice(NAME.length + 1),
      });
      void app.restored.then(() => follow(app, state, show));
    }

    // What happens in terminals and cells is seen by looking again and again.
    function follow(app, state, show) {
      const day = PageConfig.getOption("workspace");
      const settings = ServerConnection.makeSettings();
      let checked = null;
      if (!/^\d\d-/.test(day)) return;

      async function look() {
        const url = `${base}roslings/news/${day}`;
        const answer = await ServerConnection.makeRequest(url, {}, settings);
        const news = await answer.json();
        if (news.file && (await state.fetch(OPENED)) !== news.file) {
          await state.save(OPENED, news.file);
          await openFile(app, news.file);
        }
        if (checked !== null && news.checked !== checked) {
          show("check").content.url = `${base}${TABS.check.url}?at=${news.checked}`;
        }
        checked = news.checked;
      }

      async function again() {
        try {
          if (!document.hidden) await look();
        } catch (error) {
          console.debug("The server does not answer:", error); // JupyterLab says so itself
        }
        setTimeout(again, LOOK_EVERY_MS);
      }
      void again();
    }

    async function openFile(app, path) {
      const ref = `${NAME}-rover`;
      const isThere = [...app.shell.widgets("main")].some((each) => each.id === ref);
      const where = isThere ? { mode: "tab-before", ref } : { mode: "split-right" };
      const options = { ...where, activate: false };
      const words = { path, factory: "Editor", options };
      const editor = await app.commands.execute("docmanager:open", words);
      editor?.parent?.selectWidget?.(editor);
    }

    return {
      id: `${NAME}:plugin`,
      autoStart: true,
      requires: [ILayoutRestorer, IStateDB],
      activate,
    };
  }

  window._JUPYTERLAB = window._JUPYTERLAB ?? {};
  window._JUPYTERLAB[NAME] = {
    init: (scope) => {
      shared = scope;
    },
    get: async () => {
      const made = await plugin();
      return () => ({ __esModule: true, default: made });
    },
  };
})();
