# bash completion for pointhaptics
_pointhaptics() {
  local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD - 1]}" words command="${COMP_WORDS[1]}" values="" separator=""
  if [[ "$word" == "=" ]]; then # bash takes --option=value for three words
    word=""
  elif [[ "$before" == "=" ]] && ((COMP_CWORD > 2)); then
    before="${COMP_WORDS[COMP_CWORD - 2]}"
  fi
  case " @COMMANDS@ " in
    *" $command "*) ;;
    *) command=view ;;
  esac
  case "$command $before" in
@VALUES@  esac
  if [[ -n "$separator" ]]; then
    local head=""
    [[ "$word" != *,* ]] || head="${word%,*},"
    mapfile -t COMPREPLY < <(compgen -P "$head" -W "$values" -- "${word##*,}")
    compopt -o nospace 2>/dev/null
    return
  fi
  if [[ -n "$values" ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
    return
  fi
  case "$command" in
@COMMANDS_WITH_OPTIONS@    *) words="@OPTIONS_OF_VIEW@" ;;
  esac
  if ((COMP_CWORD == 1)); then
    words="@COMMANDS@ --help --version"
  fi
  if [[ "$word" == -* ]] || ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  fi
  if [[ "$word" != -* ]] && ((COMP_CWORD > 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(printf '%s\n' $words | grep -v '^-')" -- "$word")
  fi
  if [[ "$word" != -* ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -o filenames -F _pointhaptics pointhaptics
