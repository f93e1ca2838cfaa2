#!/bin/sh
# A displacement reaches 63. Where a 16-bit number's two bytes lie at 63 and 64, clang 14 writes 64, and its assembler
# silently encodes another address. usage: avr_displacements.sh FILE.s
set -eu
if grep -nE '[YZ]\+(6[4-9]|[7-9][0-9]|[0-9]{3,})' "$1" >&2; then
  echo "$1: a number lies at bytes 63 and 64 of its struct: move it by one" >&2
  exit 1
fi
