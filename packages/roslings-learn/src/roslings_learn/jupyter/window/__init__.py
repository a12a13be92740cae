"""The day in one window: what `./roslings lab` adds to JupyterLab, in JupyterLab's own words.

`layout` writes a workspace of JupyterLab for a day: the lesson, the tasks, the terminals, the desk.
`extension` is loaded by the server. It brings terminals that are ready (`terminals`), the desk
behind the server's own address and login (`desks`, `desk_proxy`), and what has happened since
(`news`). `labextension` is loaded by the page: it shows the desk and the page of a check as tabs.
"""
