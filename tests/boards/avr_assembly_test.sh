#!/bin/sh
# Displacements above 63 are corrected, or rejected if that is impossible. usage: avr_assembly_test.sh PROGRAM WORK_FILE
set -eu

# expect PROGRAM WORK_FILE FROM TO
expect() {
  printf '%b' "$3" >"$2"
  printf '%b' "$4" >"$2.expected"
  sh "$1" "$2"
  cmp "$2" "$2.expected"
}

near='\tldd\tr24, Y+63\n\tstd\tZ+62, r25\n\tldi\tr24, 64\n'
expect "$1" "$2" "$near" "$near"
expect "$1" "$2" '\tldd\tr24, Z+63\n\tldd\tr25, Z+64\n' \
  '\tldd\tr24, Z+63\n\tld\tr25, Z+\n\tldd\tr25, Z+63\n\tpush\tr25\n\tld\tr25, -Z\n\tpop\tr25\n'
expect "$1" "$2" '\tstd\tY+64, r9 ; a spill\n' \
  '\tpush\tr9\n\tld\tr9, Y+\n\tpop\tr9\n\tstd\tY+63, r9\n\tpush\tr9\n\tld\tr9, -Y\n\tpop\tr9\n'
expect "$1" "$2" '.set one, pm(other)\n' '.set one, other\n'

for wrong in 'ldd r24, Y+65' 'std Y+130, r0' 'std Z+64, r31' 'ldd r28, Y+64'; do
  printf '\tnop\n\t%s\n' "$wrong" >"$2"
  if sh "$1" "$2" 2>/dev/null; then
    echo "unnoticed: $wrong"
    exit 1
  fi
done
