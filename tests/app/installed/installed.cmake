# cmake -DBUILD=… -DPREFIX=… -DVERSION=… -P installed.cmake: installs into PREFIX and checks the result.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

foreach(file bin/molar share/man/man1/molar.1.gz share/man/man1/molar-rehearse.1.gz
        lib/molar/molar_pictures.so share/man/man1/molar-calibrate-fit.1.gz share/bash-completion/completions/molar lib/udev/rules.d/70-molar.rules share/applications/molar.desktop
        share/icons/hicolor/scalable/apps/molar.svg share/doc/molar/copyright share/doc/molar/NEWS.gz
        share/doc/molar/changelog.gz share/doc/molar/examples/feel.toml)
  if(NOT EXISTS ${PREFIX}/${file})
    message(SEND_ERROR "not installed: ${file}")
  endif()
endforeach()

execute_process(COMMAND ${PREFIX}/bin/molar --version OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
if(NOT printed MATCHES "^${VERSION}( \\([0-9a-f]+\\+?\\))?\n$")
  message(SEND_ERROR "molar --version prints: ${printed}")
endif()

# The library that writes pictures is found where it was installed.
string(REPEAT "255 " 512 cube)
file(WRITE ${PREFIX}/cube.nrrd "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 8 8 8\nspace: left-posterior-superior\n\
space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: ascii\n\n${cube}\n")
execute_process(COMMAND ${PREFIX}/bin/molar see --volume ${PREFIX}/cube.nrrd --field solid --renderer cpu --size 32x32
  --bone-only --out ${PREFIX}/picture.png OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
if(NOT EXISTS ${PREFIX}/picture.png)
  message(SEND_ERROR "the installed program writes no picture")
endif()

# The change log has an entry for this version.
execute_process(COMMAND gzip -dc ${PREFIX}/share/doc/molar/NEWS.gz OUTPUT_VARIABLE news COMMAND_ERROR_IS_FATAL ANY)
if(NOT news MATCHES "\n## ${VERSION}[,\n]")
  message(SEND_ERROR "CHANGELOG.md has no entry for ${VERSION}")
endif()

# One page per command.
execute_process(COMMAND ${PREFIX}/bin/molar completion OUTPUT_VARIABLE completion COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "command='[a-z ]+'" commands "${completion}")
file(GLOB pages ${PREFIX}/share/man/man1/*.1.gz)
list(LENGTH commands command_count)
list(LENGTH pages page_count)
math(EXPR page_count "${page_count} - 1")
if(command_count LESS 20 OR NOT command_count EQUAL page_count)
  message(SEND_ERROR "${command_count} commands, but ${page_count} manual pages")
endif()

# Syntax of manual pages, completion script and desktop entry, where a checker is installed.
find_program(GROFF groff)
if(GROFF)
  foreach(page IN LISTS pages)
    execute_process(COMMAND gzip -dc ${page} COMMAND ${GROFF} -K utf8 -man -Tutf8 -ww OUTPUT_QUIET
      ERROR_VARIABLE printed)
    if(printed)
      message(SEND_ERROR "${printed}")
    endif()
  endforeach()
endif()
find_program(SHELL_OF_COMPLETION bash)
if(SHELL_OF_COMPLETION)
  execute_process(COMMAND ${SHELL_OF_COMPLETION} -n ${PREFIX}/share/bash-completion/completions/molar
    COMMAND_ERROR_IS_FATAL ANY)
endif()
find_program(DESKTOP_FILE_VALIDATE desktop-file-validate)
if(DESKTOP_FILE_VALIDATE)
  execute_process(COMMAND ${DESKTOP_FILE_VALIDATE} ${PREFIX}/share/applications/molar.desktop
    COMMAND_ERROR_IS_FATAL ANY)
endif()
