#!/bin/bash
# with_xvfb.sh WIDTHxHEIGHTxDEPTH [OPTIONS OF XVFB...] -- COMMAND...
# Runs a command on an X server of its own, at a display number that is free. Exits as the command does.
set -u
screen=$1
shift
options=()
while [ "$1" != "--" ]; do
  options+=("$1")
  shift
done
shift

scratch=$(mktemp -d)
mkfifo "$scratch/number"
Xvfb -displayfd 3 -screen 0 "$screen" -nolisten tcp -noreset "${options[@]}" \
  3>"$scratch/number" 2>"$scratch/log" </dev/null &
server=$!
trap 'kill "$server" 2>/dev/null; wait "$server" 2>/dev/null; rm -rf "$scratch"' EXIT

if ! read -r -t 30 number <"$scratch/number"; then
  echo "Xvfb did not start:" >&2
  cat "$scratch/log" >&2
  exit 1
fi
export DISPLAY=:$number
"$@"
