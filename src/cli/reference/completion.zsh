_kerrd_devices() {
    local -a devices
    devices=('auto:the fastest that is usable' ${${(f)"$(_call_program devices $_kerrd_program doctor --devices 2> /dev/null)"}/$'\t'/:})
    _describe -t devices device devices
}

_kerrd_named_file() {
    if compset -P '*='; then
        _files
    else
        _message 'NAME=FILE'
    fi
}

# Complete a name, as NAME=, or the words that may follow the name. $1 is the name of the table of both. If $2 is set, a
# comma, several words may follow. The index of a list element may be any number.
_kerrd_named() {
    local -a rows words match mbegin mend
    local name
    rows=("${(@P)1}")
    if [[ $PREFIX =~ '^[a-z_]+\.([0-9]+)\.' ]]; then
        rows=("${(@)rows/.0./.$match[1].}")
    fi
    if compset -P 1 '*='; then
        name=${${IPREFIX%=}##*=}
        words=${rows[(r)$name=*]#*=}
        if [[ $words == ,* || -n $2 ]]; then
            compset -P '*,'
        fi
        words=(${(s:|:)${words#,}})
        _wanted values expl "$name" compadd -a words
    else
        rows=("${(@)rows%%=*}")
        _wanted fields expl field compadd -S = -a rows
    fi
}

_kerrd_quantities() {
    _describe -t quantities quantity _kerrd_physics
}

_kerrd_quantity() {
    _kerrd_arguments "physics $words[1]"
}

_kerrd() {
    local context state state_descr line _kerrd_program=$words[1]
    typeset -A opt_args
    _arguments -C '(- *)'{-\?,--help}'[Give this help list]' '(- *)--usage[Give a short usage message]' '(- *)'{-V,--version}'[Print program version]' \
        '1:command:->command' '*:: :->rest'
    case $state in
        command) _describe -t commands command _kerrd_commands ;;
        rest)
            if [[ $words[1] == help ]]; then
                _arguments '1:command:{_describe -t commands command _kerrd_commands}'
            else
                _kerrd_arguments $words[1]
            fi
            ;;
    esac
}

# If zsh loads this file as the function _kerrd, it runs the file instead of the function the first time.
if [[ $funcstack[1] == _kerrd ]]; then
    _kerrd "$@"
else
    compdef _kerrd kerrd
fi
