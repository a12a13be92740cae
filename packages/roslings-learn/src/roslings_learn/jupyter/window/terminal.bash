# What a terminal of the day's window reads first: your own settings, then all that a task of the
# course asks of a new terminal. It stands in the roslings folder, and ROS is ready in it.

if [ -f ~/.bashrc ]; then . ~/.bashrc; fi

cd -- "$ROSLINGS_FOLDER" || return
if [ -f setup.bash ]; then . ./setup.bash; fi

# What you have built is sourced, too: before the prompt, and before a command that you type after
# a build in another terminal. The names of what colcon has installed tell that there is more.
_roslings_source() {
    local built=${ROSLINGS_WS:-$HOME/roslings_ws}/install
    [ -f "$built/setup.bash" ] || return 0
    local there=("$built"/*/share/*/hook/*)
    [ "${there[*]}" != "${_roslings_sourced-}" ] || return 0
    _roslings_sourced=${there[*]}
    . "$built/setup.bash"
}
if [ -z "$(trap -p DEBUG)" ]; then trap _roslings_source DEBUG; fi
PROMPT_COMMAND="_roslings_source${PROMPT_COMMAND:+; $PROMPT_COMMAND}"

# The tab of the page keeps the name that the task uses.
if [ -n "${ROSLINGS_TERMINAL-}" ]; then PS1+="\[\e]0;Terminal $ROSLINGS_TERMINAL\a\]"; fi
