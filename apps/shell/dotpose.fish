# Completions of dotpose for fish. The tool prints one completion per line, followed by a tab and a description.
function __dotpose_complete
    set -l words (commandline -opc)
    set -l offers ($words[1] __complete $words[2..-1] (commandline -ct) 2>/dev/null)
    if test (count $offers) -gt 0
        printf '%s\n' $offers
    else
        __fish_complete_path (commandline -ct)
    end
end
complete -c dotpose -f -a '(__dotpose_complete)'
