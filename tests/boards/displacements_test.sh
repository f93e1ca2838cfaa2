#!/bin/sh
# The gate on displacements fails where it should. usage: displacements_test.sh GATE WORK_FILE
set -eu
printf '\tldd r24, Y+63\n\tstd Z+62, r25\n\tldi r24, 64\n' >"$2"
sh "$1" "$2"
for wrong in 'std Z+64, r25' 'ldd r24, Y+65' 'std Y+130, r0'; do
  printf '\tnop\n\t%s\n' "$wrong" >"$2"
  if sh "$1" "$2" 2>/dev/null; then
    echo "unnoticed: $wrong"
    exit 1
  fi
done
