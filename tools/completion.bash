# Completion for filigree in bash. It asks the command for its verbs and options, so that there is nothing to keep in
# step.
_filigree() {
    local command=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} verb=() help k
    for ((k = 1; k < COMP_CWORD; ++k)); do
        # Verbs stand first; bench has verbs of its own.
        [[ ${COMP_WORDS[k]} == -* ]] && break
        [[ $k == 1 || ${verb[0]} == bench && $k == 2 ]] || break
        verb+=("${COMP_WORDS[k]}")
    done
    help=$("$command" "${verb[@]}" --help 2> /dev/null) || return
    local words
    if [[ $word == -* ]]; then
        words=$(grep -oE '^  (-[a-z],)?--[a-z][a-z-]*' <<< "$help" | grep -oE -- '-{1,2}[a-z][a-z-]*')
    else
        words=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p' <<< "$help")
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -o bashdefault -F _filigree filigree
