# Completions of dotpose for bash. The tool prints one completion per line, followed by a tab and a
# description.
_dotpose() {
    mapfile -t COMPREPLY < <("$1" __complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null | cut -f 1)
}
complete -o default -F _dotpose dotpose
