# Set `words` to the words of the command line as they were typed. In COMP_WORDS bash has split them at = and :.
_kerrd_glue() {
    local i token gap before= rest=${COMP_LINE:0:${COMP_POINT:-0}}
    words=()
    for ((i = 0; i <= COMP_CWORD; i++)); do
        token=${COMP_WORDS[i]}
        gap=$rest
        if [[ -n $token ]]; then
            gap=${rest%%"$token"*}
            rest=${rest#"$gap$token"}
        fi
        if ((i > 1)) && [[ -z $gap && ($token == [=:]* || $before == *[=:]) ]]; then
            words[-1]+=$token
        else
            words+=("$token")
        fi
        before=$token
    done
}

# Propose files that begin with $3, or folders if $1 is -d. Each proposal has the prefix $2.
_kerrd_files() {
    local name
    compopt -o filenames 2> /dev/null
    while IFS= read -r name; do
        found+=("$2$name")
    done < <(compgen "$1" -- "$3")
}

# Propose the words of $1 that begin with $3. Each proposal has the prefix $2.
_kerrd_words() {
    local word
    for word in $1; do
        [[ $word != "$3"* ]] || found+=("$2$word")
    done
}

# Complete $2 to a name, as NAME=. If it has a name already, propose the words that may follow the name. $1 is the
# prefix of each proposal; the other arguments are the table of names and words. The index of a list element may be any
# number.
_kerrd_named() {
    local prefix=$1 value=$2 row name words index=
    shift 2
    [[ $value =~ ^[a-z_]+\.([0-9]+)\. ]] && index=${BASH_REMATCH[1]}
    for row; do
        name=${row%%=*} words=${row#*=}
        [[ -z $index ]] || name=${name/.0./.$index.}
        if [[ $value != *=* ]]; then
            [[ $name != "$value"* ]] || found+=("$prefix$name=")
        elif [[ ${value%%=*} == "$name" ]]; then
            prefix+=$name= value=${value#*=}
            if [[ $words == ,* && $value == *,* ]]; then
                prefix+=${value%,*}, value=${value##*,}
            fi
            words=${words#,}
            _kerrd_words "${words//|/ }" "$prefix" "$value"
            return
        fi
    done
    [[ $value == *=* ]] || compopt -o nospace 2> /dev/null
}

# Propose values that begin with $3. $1 is their kind, perhaps followed by words. Each proposal has the prefix $2.
_kerrd_values() {
    case $1 in
        file) _kerrd_files -f "$2" "$3" ;;
        folder) _kerrd_files -d "$2" "$3" ;;
        named-file) [[ $3 != *=* ]] || _kerrd_files -f "$2${3%%=*}=" "${3#*=}" ;;
        words\ *) _kerrd_words "${1#* }" "$2" "$3" ;;
        list\ *)
            if [[ $3 == *,* ]]; then
                _kerrd_words "${1#* }" "$2${3%,*}," "${3##*,}"
            else
                _kerrd_words "${1#* }" "$2" "$3"
            fi
            ;;
        device) _kerrd_words "auto $("${COMP_WORDS[0]}" doctor --devices 2> /dev/null | cut -f 1)" "$2" "$3" ;;
        preset) _kerrd_words "$_kerrd_presets" "$2" "$3" ;;
        playground) _kerrd_words "$_kerrd_playgrounds" "$2" "$3" ;;
        quantity) _kerrd_words "$_kerrd_quantities" "$2" "$3" ;;
        field) _kerrd_named "$2" "$3" "${_kerrd_fields[@]}" ;;
        axis)
            if [[ $3 == *=*,* ]]; then
                _kerrd_named "$2" "${3%%=*}=${3##*,}" "${_kerrd_fields[@]}"
                found=("${found[@]/#"$2${3%%=*}="/"$2${3%,*},"}")
            else
                _kerrd_named "$2" "$3" "${_kerrd_fields[@]}"
            fi
            ;;
        setting) _kerrd_named "$2" "$3" "${_kerrd_settings[@]}" ;;
    esac
}

# Read the words before the one under the cursor. Set `command`; `ended` if no more options may follow; and `waiting`
# to the option that still needs its argument.
_kerrd_read() {
    local i word
    command= waiting= ended=
    for ((i = 1; i < ${#words[@]} - 1; i++)); do
        word=${words[i]}
        if [[ -n $waiting ]]; then
            waiting=
        elif [[ $word == -- ]]; then
            ended=1
        elif [[ $word == -* && -z $ended ]]; then
            _kerrd_takes "$command" "$word"
            [[ -z $takes || -n $optional ]] || waiting=$word
        elif [[ -z $command || ($command == physics && " $_kerrd_quantities " == *" $word "*) ]]; then
            command+=${command:+ }$word
        fi
    done
}

_kerrd() {
    local -a words found=()
    local command waiting ended takes optional options= current prefix
    _kerrd_glue
    current=${words[-1]}
    _kerrd_read
    if [[ -n $waiting ]]; then
        _kerrd_takes "$command" "$waiting"
        _kerrd_values "$takes" '' "$current"
    elif [[ $current == --*=* && -z $ended ]]; then
        _kerrd_takes "$command" "${current%%=*}"
        _kerrd_values "$takes" "${current%%=*}=" "${current#*=}"
    elif [[ $current == -* && -z $ended ]]; then
        _kerrd_options "$command"
        _kerrd_words "$options" '' "$current"
        [[ ${#found[@]} -ne 1 || ${found[0]} != *= ]] || compopt -o nospace 2> /dev/null
    elif [[ -z $command || $command == help ]]; then
        _kerrd_words "$_kerrd_commands" '' "$current"
    else
        _kerrd_takes "$command" ''
        _kerrd_values "$takes" '' "$current"
    fi
    # Bash replaces only what follows the last = or :, so the proposals must not repeat what precedes it.
    prefix=
    if [[ $current == *[=:]* ]]; then
        prefix=${current%"${current##*[=:]}"}
    fi
    COMPREPLY=("${found[@]#"$prefix"}")
}
complete -F _kerrd kerrd
