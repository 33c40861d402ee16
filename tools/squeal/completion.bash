# Completes squeal's command lines in bash. What there is to complete is asked of the program itself, so this file knows no
# list of its own:
#   source tools/squeal/completion.bash
_squeal() {
    local line=${COMP_LINE:0:COMP_POINT} typed word before words
    read -ra typed <<<"$line"
    [[ $line == *" " ]] && typed+=("")
    word=${typed[-1]} before=${typed[-2]}

    case $before in
    --port) words="$("${typed[0]}" words port 2>/dev/null) $(compgen -G '/dev/ttyUSB*') $(compgen -G '/dev/ttyACM*')" ;;
    --preset) words=$("${typed[0]}" words preset 2>/dev/null) ;;
    "${typed[0]}") words=$("${typed[0]}" words 2>/dev/null) ;;
    *) words=$("${typed[0]}" words "${typed[1]}" 2>/dev/null) ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    [[ ${COMPREPLY[0]} == *[=:] ]] && compopt -o nospace 2>/dev/null
    # Readline parts words at a colon: what stands before it is not typed again.
    [[ $word == *:* ]] && COMPREPLY=("${COMPREPLY[@]#"${word%:*}":}")
}
complete -o bashdefault -o default -F _squeal squeal
