#!/bin/sh
# Links an image for AVR from LLVM bitcode. With the whole program in sight, LLVM merges equal functions, and removes
# arguments, results and functions that nobody uses: 2 % of the flash. It inlines nothing more, because code would grow.
# usage: avr_link.sh CPU IMAGE.elf BITCODE... -- [OPTION OF THE LINKER...]
set -eu
cpu=$1
image=$2
shift 2
tools=$(dirname "$0")
whole=${image%.elf}
entry_points=main,exit,memcpy,memmove,memset,memcmp
passes="internalize,ipsccp,called-value-propagation,globalopt,deadargelim,globaldce,mergefunc,globaldce"
passes="$passes,function(instcombine,simplifycfg,dse,adce)"

bitcode=
while [ "$1" != -- ]; do
  bitcode="$bitcode $1"
  shift
done
shift
# shellcheck disable=SC2086  # paths of a build folder hold no spaces
llvm-link-14 $bitcode -o "$whole.bc"
opt-14 "$whole.bc" -passes="$passes" -internalize-public-api-list="$entry_points" -o "$whole.bc"
clang++-14 --target=avr -mmcu="$cpu" -Oz -ffunction-sections -fdata-sections -Xclang -disable-llvm-passes -S "$whole.bc" \
  -o "$whole.s"
sh "$tools/avr_assembly.sh" "$whole.s"
clang++-14 --target=avr -mmcu="$cpu" -c "$whole.s" -o "$whole.o"
avr-gcc -mmcu="$cpu" -nodefaultlibs -Wl,--gc-sections,--relax "$@" "$whole.o" -lgcc -o "$image"
