#compdef dotpose
# Completions of dotpose for zsh. The tool prints one completion per line, followed by a tab and a description.
local -a offers
offers=(${(f)"$("$words[1]" __complete "${(@)words[2,CURRENT]}" 2>/dev/null | cut -f 1)"})
if (($#offers)); then compadd -a offers; else _files; fi
