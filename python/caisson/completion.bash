# SPDX-License-Identifier: LGPL-2.1-or-later
# bash completion of the command caisson, which answers itself.
_caisson() {
  local command=${COMP_WORDS[0]/#\~/$HOME}
  mapfile -t COMPREPLY < <(
    "$command" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  [ "$COMP_CWORD" -eq 1 ] || compopt -o filenames
}
complete -o default -F _caisson caisson
