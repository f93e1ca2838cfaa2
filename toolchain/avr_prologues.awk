# Makes functions for AVR smaller, as GCC's -mcall-prologues does, which clang 14 lacks: a function that saves many
# registers calls libgcc's __prologue_saves__ and __epilogue_restores__ instead of its own pushes and pops.
# usage: awk -f avr_prologues.awk FILE.s
#
# __prologue_saves__ pushes r2 to r17, r28 and r29 in this order, makes a frame of X bytes, lets Y point to it, and jumps
# to Z. __epilogue_restores__ pops from Y, which must be the stack pointer without the frame; r30 tells how many bytes. Both
# can be entered at any register. They change X, Z and r0, which hold neither arguments nor results.
# A function is left as it is if it saves other registers, or if a push, pop or end does not have the expected form.

function saved_by(at) {  # the first register of a run of pushes up to r17; 0: none
  first = line[at] ~ /^\tpush\tr[0-9]+$/ ? substr(line[at], 8) + 0 : 0
  if (first < 2 || first > 17) return 0
  for (pushes = 0; line[at + pushes] == "\tpush\tr" (first + pushes) && first + pushes <= 17;) ++pushes
  if (first + pushes != 18) return 0
  holds_y = line[at + pushes] == "\tpush\tr28" && line[at + pushes + 1] == "\tpush\tr29"
  if (holds_y) pushes += 2
  return first
}

function is_stack_set(at) {
  return line[at] == "\tin\tr0, 63" && line[at + 1] == "\tcli" && line[at + 2] == "\tout\t62, r29" &&
    line[at + 3] == "\tout\t63, r0" && line[at + 4] == "\tout\t61, r28"
}

# The bytes of the frame that is made here, and in `length` of its code; -1: none.
function frame_made(at) {
  if (line[at] != "\tin\tr28, 61" || line[at + 1] != "\tin\tr29, 62") return -1
  if (line[at + 2] ~ /^\tsbiw\tr28, [0-9]+$/ && is_stack_set(at + 3)) {
    made = 8
    return substr(line[at + 2], 12) + 0
  }
  if (line[at + 2] ~ /^\tsubi\tr28, [0-9]+$/ && line[at + 3] ~ /^\tsbci\tr29, [0-9]+$/ && is_stack_set(at + 4)) {
    made = 9
    return substr(line[at + 2], 12) + 256 * substr(line[at + 3], 12)
  }
  return -1
}

# The pops of the registers, in reverse order, and the return.
function is_end(at, i) {
  i = at
  if (holds_y && (line[i++] != "\tpop\tr29" || line[i++] != "\tpop\tr28")) return 0
  for (r = 17; r >= first; --r)
    if (line[i++] != "\tpop\tr" r) return 0
  return line[i] == "\tret"
}

function rewritten(  at, i, n, body, frame, ends, pops, others, registers) {
  for (at = 1; at <= lines && line[at] !~ /^\tpush\t/; ++at)
    if (line[at] ~ /^\t[a-z]/ && line[at] !~ /^\t\./) return 0
  if (at > lines || !saved_by(at)) return 0
  registers = holds_y ? pushes : pushes + 2
  body = at + pushes
  frame = holds_y ? frame_made(body) : -1
  if (frame >= 0) body += made
  if (pushes < (frame >= 0 ? 4 : holds_y ? 8 : 6)) return 0
  for (i = body; i <= lines; ++i) {
    if (line[i] == "\tret" || line[i] == "\treti") --ends
    if (line[i] ~ /^\tpush\t/) return 0
    if (line[i] ~ /^\tpop\t/) ++pops
    if (is_end(i)) {
      if (frame >= 0 && !is_stack_set(i - 5)) return 0
      ++ends
      others += pushes
    }
    if (!holds_y && line[i] ~ /[^0-9a-zA-Z_](Y|r28|r29)/) return 0
  }
  if (ends != 0 || pops != others) return 0

  for (i = 1; i < at; ++i) print line[i]
  n = frame > 0 ? frame : 0
  print "\tldi\tr26, " n % 256
  print "\tldi\tr27, " int(n / 256)
  print "\tldi\tr30, pm_lo8(.Lsaved" functions ")"
  print "\tldi\tr31, pm_hi8(.Lsaved" functions ")"
  print "\tjmp\t__prologue_saves__+" 2 * (first - 2)
  print ".Lsaved" functions ":"
  for (i = body; i <= lines; ++i) {
    if (frame >= 0 && is_stack_set(i) && is_end(i + 5)) i += 5
    if (is_end(i)) {
      if (holds_y && frame < 0) print "\tin\tr28, 61\n\tin\tr29, 62"
      print "\tldi\tr30, " registers
      print "\tjmp\t__epilogue_restores__+" 2 * (18 - registers)
      i += pushes
    } else {
      print line[i]
    }
  }
  return 1
}

function leave(  i) {
  for (i = 1; i <= lines; ++i) print line[i]
  lines = 0
}

# An alias has a type, too, but no end.
/^\t\.type\t.*@function/ {
  leave()
  inside = 1
}
!inside { print }
inside { line[++lines] = $0 }
/^\.Lfunc_end/ {
  ++functions
  if (rewritten()) lines = 0
  leave()
  delete line
  inside = 0
}
END { leave() }
