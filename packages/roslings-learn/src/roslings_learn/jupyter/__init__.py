"""JupyterLab on the right day: the student's copies of the lessons, the kernel, the server."""
