#compdef dotpose
# Completions of dotpose for zsh. The tool prints them, a line for each with its description after a tab.
local -a offers
offers=(${(f)"$("$words[1]" __complete "${(@)words[2,CURRENT]}" 2>/dev/null | cut -f 1)"})
if (($#offers)); then compadd -a offers; else _files; fi
