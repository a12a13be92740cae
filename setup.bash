# Makes this terminal ready for ROS 2, as /opt/ros/jazzy/setup.bash does where ROS is installed:
#
#     source setup.bash          (in each new terminal, from anywhere: source PATH/setup.bash)
#
# Where a ROS 2 Jazzy is already sourced, it adds only the command `roslings`, and the message types
# of the labs.

_roslings=$(CDPATH= cd -- "$(dirname -- "${BASH_SOURCE[0]:-$0}")" && pwd -P)

if [ -z "${ROS_DISTRO-}" ]; then
    [ -e "$_roslings/.venv/roslings" ] || "$_roslings/roslings" ready ros2 >&2
    case :$PATH: in
        *":$_roslings/.venv/bin:"*) ;;
        *) export PATH=$_roslings/.venv/bin:$PATH ;;
    esac
    case :${AMENT_PREFIX_PATH-}: in
        *":$_roslings/.venv:"*) ;;
        *) export AMENT_PREFIX_PATH=${AMENT_PREFIX_PATH:+$AMENT_PREFIX_PATH:}$_roslings/.venv ;;
    esac
    # Nodes announce themselves quickly, as those do that `ros2 run` starts: two find each other in
    # milliseconds, also where you start one with plain python3.
    export FASTRTPS_DEFAULT_PROFILES_FILE=${FASTRTPS_DEFAULT_PROFILES_FILE:-$_roslings/packages/ros2-on-pip/src/ros2_on_pip/quick_discovery.xml}
    # The Tab key completes the words of ros2. What it needs is read when Tab is first pressed: it
    # comes with the first `ros2`.
    if [ -n "${BASH_VERSION-}" ]; then
        _roslings_complete() {
            eval "$(register-python-argcomplete ros2 2>/dev/null)"
            # 124 makes bash ask again, now with what was read.
            case $(complete -p ros2) in *_roslings_complete*) return 1 ;; *) return 124 ;; esac
        }
        complete -F _roslings_complete ros2
    fi
elif [ -d "$_roslings/.venv-apt/overlay" ]; then
    # The message types that a lab brings, once `./roslings start` has built them.
    _overlay=$_roslings/.venv-apt/overlay
    case :${AMENT_PREFIX_PATH-}: in
        *":$_overlay:"*) ;;
        *)
            export AMENT_PREFIX_PATH=$_overlay${AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}
            export CMAKE_PREFIX_PATH=$_overlay${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}
            export LD_LIBRARY_PATH=$_overlay/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
            for _folder in "$_overlay"/lib/python3*/*-packages; do
                export PYTHONPATH=$_folder${PYTHONPATH:+:$PYTHONPATH}
            done
            unset _folder ;;
    esac
    unset _overlay
fi

# Your nodes talk to each other on this computer only, and not with the neighbour's robot. With a
# robot of your own on the network, say SUBNET before you source this file.
export ROS_AUTOMATIC_DISCOVERY_RANGE=${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}

# Nor with those of another person on this computer. Said once in each terminal.
_roslings_known=${ROS_DOMAIN_ID-}
. "$_roslings/packages/roslings-launcher/src/roslings_launcher/domain.sh"

case :$PATH: in
    *":$_roslings:"*) [ -z "$_roslings_known" ] || _roslings_said= ;;
    *) export PATH=$PATH:$_roslings ;;
esac
if [ -n "$_roslings_said" ]; then printf '%s\n' "$_roslings_said" >&2; fi
unset _roslings_said _roslings_known
# One line for whoever types it; a script that sources this file has nobody to tell.
if [ -t 1 ] && { [ -n "${ROS_DISTRO-}" ] || [ -e "$_roslings/.venv/roslings" ]; }; then
    case $- in *i*) echo "ROS 2 ${ROS_DISTRO:-jazzy} is ready in this terminal." ;; esac
fi
unset _roslings
