#!/bin/sh
# Corrects FILE.s. The largest displacement is 63. If the two bytes of a 16-bit number lie at 63 and 64, clang 14 writes
# 64, and its assembler silently encodes another address. Instead, the pointer moves on by one and back; loads that move
# it keep the flags. Also, clang 14 writes an alias as a program memory address, which its assembler rejects.
# Before that, avr_prologues.awk makes functions smaller.
# usage: avr_assembly.sh FILE.s
set -eu
awk -f "$(dirname "$0")/avr_prologues.awk" "$1" >"$1.smaller"
awk '
  /^\.set .*, pm\(.*\)$/ {
    sub(/pm\(/, "")
    sub(/\)$/, "")
  }
  $1 ~ /^(ldd|std)$/ && match($0, /[YZ]\+[0-9]+/) && substr($0, RSTART + 2, RLENGTH - 2) + 0 > 63 {
    pointer = substr($0, RSTART, 1)
    displacement = substr($0, RSTART + 2, RLENGTH - 2)
    match($0, /r[0-9]+/)
    register = substr($0, RSTART, RLENGTH)
    own = pointer == "Y" ? "^r(28|29)$" : "^r(30|31)$"
    if (displacement != 64 || register ~ own) {
      print FILENAME ":" FNR ": no way to mend this:" $0 | "cat >&2"
      exit 1
    }
    load = "\tld\t" register ", "
    save = "\tpush\t" register
    restore = "\tpop\t" register
    if ($1 == "ldd") {
      print load pointer "+"
      print "\tldd\t" register ", " pointer "+63"
    } else {
      print save
      print load pointer "+"
      print restore
      print "\tstd\t" pointer "+63, " register
    }
    print save
    print load "-" pointer
    print restore
    next
  }
  { print }
' "$1.smaller" >"$1.mended"
rm "$1.smaller"
mv "$1.mended" "$1"
