# A ROS domain for each user of a computer that several share. setup.bash and ./roslings read this.
#
# Nodes of one computer and one domain hear each other, whoever started them: on a server with thirty
# students all would drive one rover. Who sets ROS_DOMAIN_ID, or lets nodes look beyond this
# computer, has chosen, and nothing is changed. Afterwards `_roslings_said` is the line to say, or
# empty; where the system has no `id` or `ls`, nothing is changed either.
#
# Others share a computer where they are logged in, or where their folders lie beside ours. Folders
# do not count in a container: images bring users of their own. Who came by a JupyterHub is never
# alone, also where no other has come yet. The number of a user gives the
# domain, 1 to 101, so that all terminals of one user agree; the numbers of a class follow each other.
#
# ROSLINGS_OWN_DOMAIN tells programs within that nobody chose it: a terminal of JupyterLab says it too.

_roslings_said=
if [ -z "${ROS_DOMAIN_ID-}" ] && [ "${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}" = LOCALHOST ]; then
    _roslings_me=$(id -u 2>/dev/null)
    _roslings_homes=${HOME-}
    _roslings_homes=${_roslings_homes%/*}
    if [ -e /.dockerenv ] || [ -e /run/.containerenv ]; then _roslings_homes=; fi
    # `ls -dn` has a line for each, whose third word is the owner's number. People's begin with 1000;
    # 65534 is nobody. Processes from 60000 on are of users that programs make, in containers, say.
    _roslings_others=${JUPYTERHUB_USER:-$(
        {
            ls -dn /proc/[0-9]* /run/user/[0-9]*
            [ -z "$_roslings_homes" ] || ls -dn "$_roslings_homes"/*/
        } 2>/dev/null | while read -r _ _ _roslings_owner _roslings_rest; do
            case $_roslings_owner in '' | *[!0-9]* | "$_roslings_me" | 65534) continue ;; esac
            case $_roslings_rest in
                */proc/[0-9]*) [ "$_roslings_owner" -lt 60000 ] || continue ;;
            esac
            if [ "$_roslings_owner" -ge 1000 ]; then echo yes && break; fi
        done
    )}
    if [ -n "$_roslings_me" ] && [ -n "$_roslings_others" ]; then
        export ROS_DOMAIN_ID=$((_roslings_me % 101 + 1))
        export ROSLINGS_OWN_DOMAIN=$ROS_DOMAIN_ID
    fi
    unset _roslings_me _roslings_homes _roslings_others
fi
if [ -n "${ROSLINGS_OWN_DOMAIN-}" ] && [ "$ROSLINGS_OWN_DOMAIN" = "${ROS_DOMAIN_ID-}" ]; then
    _roslings_said="roslings: several people use this computer, so your ROS_DOMAIN_ID is $ROS_DOMAIN_ID."
fi
