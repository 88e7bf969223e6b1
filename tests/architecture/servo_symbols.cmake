# What the servo's thread can reach, read from the machine code: starting at Servo::step, at the steps of a file, at the
# tick of the loop with its motor gate, at the virtual functions they call, and at the part of every device that runs on this thread (of a
# simulated Phantom all but its script, a function passed to it), all calls and references are followed through the
# archives, and every symbol outside them must be on the short list below. So an allocation in a constructor passes and
# one behind a rare branch fails, whether a test runs it or not. Calls through pointers cannot be followed: functions
# that make one, or wait for the operating system, are on the second list with the reason.
# Run: cmake -DOBJDUMP=… -DARCHIVES=a.a,b.a [-DROOTS=regex,regex] -P servo_symbols.cmake  (x86-64 objects, mangled names)
cmake_minimum_required(VERSION 3.25)

# Bounded, lock-free and without memory of their own: libm, memory moves, and the ways an internal error ends the program.
set(allowed
  "^(sqrt|cbrt|hypot|floor|ceil|round|trunc|rint|nearbyint|lround|llround|lrint|fma|fmod|fmin|fmax|exp|exp2|expm1|log|log2|log1p|pow|sin|cos|sincos|tan|asin|acos|atan|atan2|erf|erfc|copysign|ldexp|frexp|modf)f?$"
  "^(memcpy|memmove|memset|memcmp|clock_gettime|_ZNSt6chrono3_V212steady_clock3nowEv)$"
  "^(__assert_fail|abort|_ZSt9terminatev|__gxx_personality_v0|_Unwind_Resume|__cxa_begin_catch|__stack_chk_fail)$"
  "^(_GLOBAL_OFFSET_TABLE_|_ZTV.*|_ZTI.*|_ZTS.*)$")
list(JOIN allowed "|" allowed)

# FUNCTION>TARGET: a reference that is allowed in one function only.
set(admitted
  # The tick calls virtual functions of the classes derived from the loop; all of them are roots themselves.
  "^_ZN7haptics10DeviceLoop4tickE.*>indirect$"
  # The thread of a paced device sleeps until its tick, then calls servo, sensors and motors, which are roots too.
  "^_ZN7haptics11PacedDevice(3run|4tick|4step)E.*>indirect$"
  "^_ZN7haptics(11PacedDevice(3run|4tick|5await)|10sleepUntil)E.*>clock_nanosleep$"
  # The wait for a report has a deadline; raising and lowering are one write to, one read from an eventfd that never
  # blocks.
  "^_ZN7haptics10WakeSignal10awaitUntilE.*>ppoll$"
  "^_ZN7haptics10WakeSignal5raiseE.*>write$"
  "^_ZN7haptics10WakeSignal5lowerE.*>read$"
  # A led hand calls its script, a function passed to it.
  "^_ZN7haptics7LedHand8exchangeE.*>(indirect|_ZSt25__throw_bad_function_callv)$"
  # The functions of the vendor's library, whose bounds its maker states; and the tick.
  "^_ZNK?7haptics(11OpenHaptics|8HdHandle|8HdErrors|13HdCalibration)[0-9].*>indirect$")
list(JOIN admitted "|" admitted)
if(NOT DEFINED ROOTS)
  string(JOIN "," ROOTS
    "^_ZN7haptics5Servo4stepE" "^_ZN7haptics11FileInCanal4stepE" "^_ZN7haptics8Rk4Chain4stepE"
    "^_ZN7haptics10DeviceLoop4tickE" "^_ZNK7haptics9MotorGate5admitE"
    "^_ZN7haptics10HapticLoop6answerE" "^_ZN7haptics10HapticLoop8answeredE" "^_ZN7haptics17InstrumentTracker6answerE"
    "^_ZN7haptics14HandleRecorder6answerE" "^_ZN3app17ConstantForceLoop6answerE" "^_ZN3app14PracticeStylus8exchangeE"
    "^_ZN7haptics11PacedDevice3runE" "^_ZN7haptics11PacedDevice5awaitE"
    "^_ZN7haptics[A-Za-z0-9]+(Hand|Device)8exchangeE"
    "^_ZN7haptics16SimulatedPhantom4moveE" "^_ZN7haptics16SimulatedPhantom6rotateE"
    "^_ZN7haptics16SimulatedPhantom12motorForce_NE" "^_ZN7haptics14PhantomSensors4readE"
    "^_ZN7haptics6Falcon5senseE" "^_ZN7haptics6Falcon5driveE" "^_ZN7haptics6Falcon5awaitE"
    "^_ZN7haptics13WoodenHaptics5senseE" "^_ZN7haptics13WoodenHaptics5driveE" "^_ZN7haptics13WoodenHaptics5awaitE"
    "^_ZN7haptics11OpenHaptics5serveE")
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

set(waiting "")
string(REPLACE "," ";" ROOTS "${ROOTS}")
foreach(root IN LISTS ROOTS)
  set(matching ${functions})
  list(FILTER matching INCLUDE REGEX "${root}")
  if(NOT matching)
    message(FATAL_ERROR "no function matches ${root}: it has moved, say where to")
  endif()
  list(APPEND waiting ${matching})
endforeach()
list(REMOVE_DUPLICATES waiting)
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
    elseif(NOT target MATCHES "${allowed}" AND NOT target MATCHES "^\\." AND NOT "${function}>${target}" MATCHES "${admitted}")
      math(EXPR violations "${violations} + 1")
      execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${path_${function}} > ${target}" COMMAND c++filt OUTPUT_VARIABLE told)
      string(STRIP "${told}" told)
      message("the servo's thread reaches what is not known to be bounded: ${told}")
    endif()
  endforeach()
endwhile()

if(violations GREATER 0)
  message(FATAL_ERROR "${violations} references against the rule in ${reached} functions")
endif()
message("${reached} functions reached from the servo's thread, none allocates, locks, throws or waits but as listed")
