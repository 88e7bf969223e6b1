# From `objdump -dr --no-show-raw-insn` of x86-64 objects: a line "FUNCTION" for each function found, and a line
# "FUNCTION TARGET" for each function or symbol it calls, jumps to or takes the address of. TARGET "indirect" is a call
# through a pointer. Two local functions of one name count as one.
function hex(digits,    value, i) {
  value = 0
  for (i = 1; i <= length(digits); ++i) value = value * 16 + index("0123456789abcdef", substr(digits, i, 1)) - 1
  return value
}
function refer(target) {
  if (target != current && !((current, target) in seen)) {
    seen[current, target] = 1
    from[++references] = current
    to[references] = target
  }
}
/file format/ { object = $1 }
/^Disassembly of section / { section = $4; sub(/:$/, "", section) }
/^[0-9a-f]+ <.*>:$/ {
  current = substr($2, 2, length($2) - 3)
  ++functions
  name[functions] = current
  home[functions] = object section
  start[functions] = hex($1)
  print current
  next
}
# References that the linker resolves: to a symbol, or to a place in a section of this object.
/R_X86_64_/ {
  target = $NF
  sign = match(target, /[+-]0x[0-9a-f]+$/)
  addend = 0
  if (sign) {
    addend = hex(substr(target, sign + 3))
    if (substr(target, sign, 1) == "-") addend = -addend
    target = substr(target, 1, sign - 1)
  }
  if (target ~ /^\.text/) refer("@" object target "@" addend + 4)
  else if (target !~ /^\./) refer(target)
  next
}
# References inside one section are resolved already.
/\t(call|jmp|j[a-z]+) +[0-9a-f]+ </ {
  target = $NF
  gsub(/[<>]/, "", target)
  sub(/\+0x[0-9a-f]+$/, "", target)
  refer(target)
}
/\tcall +\*/ { refer("indirect") }
/\tjmp +\*[^%]/ { refer("indirect") }
END {
  for (i = 1; i <= references; ++i) {
    target = to[i]
    if (substr(target, 1, 1) == "@") {
      split(target, part, "@")
      best = 0
      for (f = 1; f <= functions; ++f) {
        if (home[f] == part[2] && start[f] <= part[3] && (!best || start[f] > start[best])) best = f
      }
      target = best ? name[best] : part[2]
    }
    if (target != from[i]) print from[i], target
  }
}
