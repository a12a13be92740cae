"""What Jazzy's launch files can say, and ours cannot: right there, and not read here.

From the names under which Jazzy's packages `launch` and `launch_ros` expose their actions and
substitutions, and from what the actions' `parse` takes.
"""

from __future__ import annotations

ELEMENTS = frozenset({
    "append_env", "executable", "for", "for_each", "lifecycle_node", "lifecycle_transition",
    "load_composable_node", "node_container", "pop_env", "pop_vars", "push_env", "push_vars",
    "reset", "reset_env", "ros_timer", "set_parameter", "set_parameters_from_file", "set_remap",
    "set_ros_log_dir", "set_use_sim_time", "shutdown", "timer", "unset", "unset_env",
})  # fmt: skip

SUBSTITUTIONS = frozenset({
    "all", "and", "anon", "any", "command", "equals", "eval", "exec-in-pkg", "file-content",
    "find-exec", "for-var", "if", "index", "launch_log_dir", "log_dir", "not", "not-equals",
    "optenv", "or", "param",
})  # fmt: skip

NODE_ATTRIBUTES = frozenset({
    "exec_name", "on_exit", "respawn", "respawn_delay", "respawn_max_retries", "shell",
    "sigkill_timeout", "sigterm_timeout",
})  # fmt: skip
