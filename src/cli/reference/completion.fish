# Whether the command typed so far is $argv: nothing, a command, or "physics" and a quantity.
function __kerrd_is
    set -l typed
    for word in (commandline -opc)[2..]
        if not set -q typed[1]
            string match -q -- '-*' $word; or set typed $word
        else if test "$typed" = physics; and contains -- $word $__kerrd_quantities
            set -a typed $word
        end
    end
    test "$typed" = "$argv"
end

function __kerrd_devices
    printf 'auto\tthe fastest that is usable\n'
    command kerrd doctor --devices 2>/dev/null
end

# Complete a name, as NAME=, or the words that may follow the name. $argv is the table of both. The index of a list
# element may be any number.
function __kerrd_named
    set -l token (string replace -r -- '^--[a-z-]+=' '' (commandline -ct))
    set -l index (string match -r '^[a-z_]+\.([0-9]+)\.' -- $token)[2]
    set -l names
    for row in $argv
        set -l parts (string split -m 1 = -- $row)
        set -l name $parts[1]
        test -z "$index"; or set name (string replace .0. .$index. -- $name)
        if string match -q -- "$name=*" $token
            set -l before $name=
            if string match -q -- '*,*' $token
                set before (string replace -r -- ',[^,]*$' , $token)
            end
            for word in (string split '|' -- (string trim -l -c , -- $parts[2]))
                test -z "$word"; or echo $before$word
            end
            return
        end
        set -a names $name=
    end
    string match -q -- '*=*' $token; or printf '%s\n' $names
end
