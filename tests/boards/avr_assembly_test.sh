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

# function FIRST_LINES BODY LAST_LINES
function_of() {
  printf '%s' "\t.type\tf,@function\nf:\n; %bb.0:\n$1$2$3.Lfunc_end0:\n"
}
# pushes FROM TO, pops FROM TO
pushes() { seq -s '' -f '\tpush\tr%g\n' "$1" "$2"; }
pops() { seq -s '' -f '\tpop\tr%g\n' "$2" -1 "$1"; }
call() {
  printf '%s' "\tldi\tr26, $1\n\tldi\tr27, $2\n\tldi\tr30, pm_lo8(.Lsaved1)\n\tldi\tr31, pm_hi8(.Lsaved1)\n"
  printf '%s' "\tjmp\t__prologue_saves__+$3\n.Lsaved1:\n"
}
body='\tmovw\tr12, r24\n'
stack='\tin\tr0, 63\n\tcli\n\tout\t62, r29\n\tout\t63, r0\n\tout\t61, r28\n'
# A frame of 300 bytes.
expect "$1" "$2" \
  "$(function_of "$(pushes 2 17)$(pushes 28 29)\tin\tr28, 61\n\tin\tr29, 62\n\tsubi\tr28, 44\n\tsbci\tr29, 1\n$stack" "$body" \
    "\tsubi\tr28, 212\n\tsbci\tr29, 254\n$stack$(pops 28 29)$(pops 2 17)\tret\n")" \
  "$(function_of "$(call 44 1 0)" "$body" \
    '\tsubi\tr28, 212\n\tsbci\tr29, 254\n\tldi\tr30, 18\n\tjmp\t__epilogue_restores__+0\n')"
# No frame, and Y is not used; two ends.
both="$(pops 10 17)\tret\n.L1:\n$body$(pops 10 17)\tret\n"
end='\tldi\tr30, 10\n\tjmp\t__epilogue_restores__+16\n'
expect "$1" "$2" "$(function_of "$(pushes 10 17)" "$body" "$both")" \
  "$(function_of "$(call 0 0 16)" "$body" "$end.L1:\n$body$end")"
# Y holds a pointer.
expect "$1" "$2" "$(function_of "$(pushes 8 17)$(pushes 28 29)" "$body" "$(pops 28 29)$(pops 8 17)\tret\n")" \
  "$(function_of "$(call 0 0 12)" "$body" \
    '\tin\tr28, 61\n\tin\tr29, 62\n\tldi\tr30, 12\n\tjmp\t__epilogue_restores__+12\n')"
# Left as they are: few registers, a gap, a jump into the end, a push in between, another end, Y in use but not saved.
for kept in \
  "$(function_of "$(pushes 14 17)" "$body" "$(pops 14 17)\tret\n")" \
  "$(function_of "$(pushes 4 9)$(pushes 12 17)" "$body" "$(pops 12 17)$(pops 4 9)\tret\n")" \
  "$(function_of "$(pushes 8 17)" "$body" "$(pops 12 17).L1:\n$(pops 8 11)\tret\n")" \
  "$(function_of "$(pushes 8 17)" '\tpush\tr24\n' "$(pops 8 17)\tret\n")" \
  "$(function_of "$(pushes 8 17)" '\tret\n' "$(pops 8 17)\tret\n")" \
  "$(function_of "$(pushes 8 17)" '\tld\tr24, Y+\n' "$(pops 8 17)\tret\n")" \
  '\t.type\tf,@function\n.set f, g\n'; do
  expect "$1" "$2" "$kept" "$kept"
done
