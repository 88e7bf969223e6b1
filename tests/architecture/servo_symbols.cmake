# What one servo tick can reach, read from the machine code: starting at haptics::Servo::step, HapticLoop::answer and the
# exchange() of devices in numbers (of a simulated Phantom all but its script, which is a function it is given), all
# calls and references are followed through the archives, and whatever leaves them must be on the short list below. So
# an allocation in a constructor is fine and one behind a rare branch of the step is not, whether a test runs it or not.
# Calls through pointers can not be followed, so the step may make none.
# Run: cmake -DOBJDUMP=… -DARCHIVES=a.a,b.a [-DROOTS=regex] -P servo_symbols.cmake   (x86-64 objects, mangled names)
cmake_minimum_required(VERSION 3.25)

# Bounded, lock-free and without memory of their own: libm, memory moves, and the ways a bug of ours ends the program.
set(allowed
  "^(sqrt|cbrt|hypot|floor|ceil|round|trunc|rint|nearbyint|lround|llround|lrint|fma|fmod|fmin|fmax|exp|exp2|expm1|log|log2|log1p|pow|sin|cos|sincos|tan|asin|acos|atan|atan2|erf|erfc|copysign|ldexp|frexp|modf)f?$"
  "^(memcpy|memmove|memset|memcmp|clock_gettime)$"
  "^(__assert_fail|abort|_ZSt9terminatev|__gxx_personality_v0|_Unwind_Resume|__cxa_begin_catch|__stack_chk_fail)$"
  "^(_GLOBAL_OFFSET_TABLE_|_ZTV.*|_ZTI.*|_ZTS.*)$")
list(JOIN allowed "|" allowed)
if(NOT DEFINED ROOTS)
  set(ROOTS "^_ZN7haptics5Servo4stepE|^_ZN7haptics10HapticLoop(6answer|8answered)E|^_ZN7haptics[A-Za-z0-9]+(Hand|Device)8exchangeE|^_ZN7haptics16SimulatedPhantom(4move|4turn|15forceOfMotors_N)E|^_ZN7haptics14PhantomSensors4readE")
endif()

# One line per function, and one per reference out of it.
string(REPLACE "," ";" archives "${ARCHIVES}")
set(code "")
foreach(archive IN LISTS archives)
  execute_process(
    COMMAND ${OBJDUMP} -dr --no-show-raw-insn ${archive}
    COMMAND awk -f ${CMAKE_CURRENT_LIST_DIR}/references.awk
    OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
  string(APPEND code "${found}")
endforeach()

string(REPLACE "\n" ";" lines "${code}")
set(functions "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+) (.+)$")
    list(APPEND "refers_${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
  elseif(line)
    set("known_${line}" TRUE)
    list(APPEND functions "${line}")
  endif()
endforeach()

set(waiting ${functions})
list(FILTER waiting INCLUDE REGEX "${ROOTS}")
if(NOT waiting)
  message(FATAL_ERROR "no function matches ${ROOTS}: the step has moved")
endif()
foreach(root IN LISTS waiting)
  set("path_${root}" "${root}")
endforeach()

set(reached 0)
set(violations 0)
while(waiting)
  list(POP_FRONT waiting function)
  if("done_${function}" IN_LIST finished)
    continue()
  endif()
  list(APPEND finished "done_${function}")
  math(EXPR reached "${reached} + 1")
  foreach(target IN LISTS "refers_${function}")
    if(known_${target})
      if(NOT DEFINED "path_${target}")
        set("path_${target}" "${path_${function}} > ${target}")
        list(APPEND waiting "${target}")
      endif()
    elseif(NOT target MATCHES "${allowed}" AND NOT target MATCHES "^\\.")
      math(EXPR violations "${violations} + 1")
      execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${path_${function}} > ${target}" COMMAND c++filt OUTPUT_VARIABLE told)
      string(STRIP "${told}" told)
      message("the servo step reaches what is not known to be bounded: ${told}")
    endif()
  endforeach()
endwhile()

if(violations GREATER 0)
  message(FATAL_ERROR "${violations} references against the rule in ${reached} functions")
endif()
message("${reached} functions reached from the servo step, none allocates, locks, throws or asks the system")
