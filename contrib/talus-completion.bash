# Completion of talus for bash: source it, or put it into /etc/bash_completion.d.
#   talus <TAB>                    options and parameter files
#   talus FILE.prm --set "Tr<TAB>  entries of the objects that the file has chosen, as Section/Entry
_talus_entries() {  # of a parameter file, one a line; $3 is --element for that of a single point
  "$1" --parameters "$2" ${3:+"$3"} 2> /dev/null | awk '
    $1 == "subsection" { path = path substr($0, index($0, $2)) "/"; next }
    $1 == "end" { sub(/[^\/]*\/$/, "", path); next }
    $1 == "set" { entry = $0; sub(/^ *set /, "", entry); sub(/ *=.*/, "", entry); print path entry }'
}

_talus() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} file line element=
  COMPREPLY=()
  if [[ $previous == --set || $previous == --sweep ]]; then
    for file in "${COMP_WORDS[@]}"; do [[ $file == *.prm ]] && break; done
    [[ -f $file ]] || return
    [[ " ${COMP_WORDS[*]} " == *" --element "* ]] && element=--element
    word=${word#[\"\']}
    while IFS= read -r line; do
      [[ $line == "$word"* ]] && COMPREPLY+=("\"$line = ")
    done < <(_talus_entries "${COMP_WORDS[0]}" "$file" "$element")
    compopt -o nospace
  elif [[ $previous == --resume ]]; then
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "--set --sweep --resume --check --element --parameters --list --help --version" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- "$word"; compgen -d -S / -- "$word")
    compopt -o nospace
  fi
}
complete -F _talus talus
