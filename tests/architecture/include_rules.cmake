# Which folder may include which, over every #include of the product. Run: cmake -DROOT=<project> -P include_rules.cmake
#   calibration < assets < { haptics | render } < app; tests see all. Left never includes right.
#   calibration: geometry < arm < the rig < fit < { webcam | verification } < { synthetic | record }.
#   assets: root words < { mesh | scan | scenery } < { patient | instrument | segment | synthetic }, segment < import.
#   app: text < { case | report | session | sound } < { view | device } < station < options < controls < instructor
#     < { procedure | study < evaluation } < rehearsal < commands; beside them { pattern | doctor | calibrate | psychophysics
#     | start_screen | review | check_page | imaging_server }; before commands, after rehearsal and review: debrief.
#   haptics: { device < safety < loop | bone, tool < body < { contact | ligament | file } } < servo.   render: gpu < { volume | scene | display } < the frame renderer.
# A third party belongs to the folders named here and to their .cpp files alone; GLM is the shared vocabulary.
cmake_minimum_required(VERSION 3.25)

set(calibration calibration/)
set(calibration/geometry calibration/geometry/)
set(calibration/arm calibration/geometry/ calibration/arm/)
set(calibration_words calibration/geometry/ calibration/arm/ calibration/random.h calibration/rig.h calibration/median.h
    calibration/calibration_error.h calibration/checked_yaml.h calibration/yaml_writer.h calibration/png_file.h calibration/opencv_module.h)
set(calibration/fit ${calibration_words} calibration/fit/)
set(calibration/webcam ${calibration_words} calibration/fit/ calibration/webcam/)
set(calibration/verification ${calibration_words} calibration/fit/ calibration/verification/)
set(calibration/synthetic ${calibration_words} calibration/fit/ calibration/webcam/ calibration/verification/
    calibration/synthetic/)
set(calibration/record ${calibration_words} calibration/output_file.h calibration/fit/ calibration/verification/ calibration/record/)
# Folders of assets: plain types at the root, then readers and writers, then the folders that combine them.
set(assets_words calibration/ assets/ct_volume.h assets/cut_field.h assets/instruction_set.h assets/json_depth.h assets/load_error.h assets/mesh.h assets/metal_fragment.h
    assets/operative_site.h assets/opposing_teeth.h assets/patient.h assets/planned_cut.h assets/prepared_tooth.h assets/progress.h assets/proposed.h assets/scan_origin.h assets/soft_tissue.h assets/soft_tissue_field.h assets/bur_outline.h assets/handpiece_outline.h assets/surface_smoothing.h
    assets/smooth_distance.h assets/solid_sample.h assets/solid_voxels.h assets/structure_distance.h assets/risk_structures.h assets/tissue.h assets/toml_reader.h assets/tooth.h assets/tooth_canals.h assets/tooth_sampler.h assets/trilinear.h assets/vertex_normals.h assets/volume_grid.h)
set(assets_root ${assets_words})
foreach(room mesh scan scenery)
  set(assets/${room} ${assets_words} assets/${room}/)
endforeach()
foreach(room patient instrument segment synthetic)
  set(assets/${room} ${assets_words} assets/mesh/ assets/scan/ assets/scenery/ assets/${room}/)
endforeach()
set(assets/import ${assets_words} assets/mesh/ assets/scan/ assets/scenery/ assets/segment/ assets/import/)
set(assets calibration/ assets/)

# Folders of app: each may include itself and those before it; the last group is for commands only.
set(floors calibration/ assets/ haptics/ render/)
set(app/text ${floors} app/text/)
set(case_report_session app/case/ app/report/ app/session/ app/sound/)
foreach(room case report session sound)
  set(app/${room} ${floors} app/text/ app/${room}/)
endforeach()
foreach(room view device)
  set(app/${room} ${floors} app/text/ ${case_report_session} app/${room}/)
endforeach()
set(seen ${floors} app/text/ ${case_report_session} app/view/ app/device/)
foreach(room station options controls instructor)
  list(APPEND seen app/${room}/)
  set(app/${room} ${seen})
endforeach()
set(app/procedure ${seen} app/procedure/)
set(app/evaluation ${seen} app/study/ app/evaluation/)
set(app/rehearsal ${seen} app/procedure/ app/evaluation/ app/rehearsal/)
foreach(room pattern doctor calibrate psychophysics start_screen study review check_page imaging_server)
  set(app/${room} ${seen} app/procedure/ app/${room}/)
endforeach()
set(app/debrief ${seen} app/procedure/ app/study/ app/evaluation/ app/rehearsal/ app/review/ app/debrief/)
set(app/commands ${floors} app/)
set(app_root ${floors} app/commands/ app/text/command_line.h app/text/message.h app/text/version.h)
set(tests ${floors} app/ tests/)

# Inside haptics and render a sub-folder names what it may include; the folder itself may include all of its own. The
# plain types of haptics (what crosses threads, wrenches) and of render lie at the root of each.
set(haptics ${assets} haptics/)
set(haptics_plain haptics/latest.h haptics/spsc_ring.h haptics/wrench.h haptics/motor_command.h)
set(haptics/device ${assets} ${haptics_plain} haptics/device/)
set(haptics/safety ${assets} ${haptics_plain} haptics/device/ haptics/safety/)
set(haptics/loop ${assets} ${haptics_plain} haptics/device/ haptics/safety/ haptics/loop/)
set(haptics/bone ${assets} haptics/bone/ haptics/tool/)
set(haptics/tool ${assets} haptics/bone/ haptics/tool/)
set(haptics/body ${assets} haptics/bone/ haptics/tool/ haptics/body/)
set(haptics/contact ${assets} haptics/bone/ haptics/tool/ haptics/body/ haptics/contact/)
set(haptics/ligament ${assets} haptics/wrench.h haptics/bone/ haptics/tool/ haptics/body/ haptics/ligament/)
# A file stands on the live wall alone.
set(haptics/file ${assets} haptics/wrench.h haptics/bone/ haptics/contact/ haptics/file/)
set(haptics/servo ${haptics})
set(render ${assets} render/)
set(render_words ${assets} render/frame.h render/image.h render/shaders/shared_constants.glsl
    render/shaders/anaglyph_constants.glsl render/shaders/light_constants.glsl)
set(render/gpu ${render_words} render/gpu/)
foreach(part volume scene display)
  set(render/${part} ${render_words} render/gpu/ render/${part}/)
endforeach()
# The CPU back-end is an alternative to gpu: of that folder it may include the exception and the window target only.
set(render/cpu ${render_words} render/gpu/gpu_error.h render/gpu/window_target.h render/cpu/ render/volume/ render/display/
    render/scene/models.h render/eye_block.h render/soft_block.h render/tool_block.h
    render/scene_renderer.h render/render_options.h render/shaders/)

# Third parties: a regular expression of what is included, and the folders or rooms that may.
set(third_parties
  "opencv2/|Eigen/|libqhull_r/" "calibration"
  "openvdb/|nanovdb/|itk|gdcm|tiny_gltf|nifti1" "assets"
  "zlib" "calibration|assets"
  "fmt/" "calibration|app"
  "toml\\+\\+/" "assets|app"
  "cairo|pango/" "render|app"
  "nlohmann/" "assets|app"
  "tbb/|oneapi/" "assets|haptics|render|app/check_page"
  "libevdev/" "haptics"
  "boost/math/" "app/study"
  "sodium|zip\\.h" "app/study"
  "boost/(asio|beast|interprocess)|turbojpeg" "app/evaluation"
  "libusb" "haptics"
  "webrtc/" "app/evaluation"
  "GLFW/" "render|app"
  "embree3/" "render"
  "epoxy/" "render"
  "openssl/" "calibration|app/evaluation"
  "CLI/" "app/text"
  "curl/|dcmtk/" "app/imaging_server"
  "spdlog/|imgui|backends/imgui|SQLiteCpp/|sqlite3|zstd|portaudio|sndfile" "app")
set(operating_system
  "^((sys|arpa|netinet)/[a-z]+|linux/[a-z0-9-]+|unistd|fcntl|netdb|pthread|pwd|sched|signal|spawn|time|poll|dlfcn|malloc|link|termios|immintrin|x86intrin)\\.h$")

set(violations 0)
macro(violation text)
  math(EXPR violations "${violations} + 1")
  message("${file}: ${text}")
endmacro()

function(starts_with_one_of result name)
  set(${result} FALSE PARENT_SCOPE)
  foreach(prefix IN LISTS ARGN)
    string(FIND "${name}" "${prefix}" at)
    if(at EQUAL 0)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# The rule of a file: of its sub-folder if that has one, else of its top folder. Where the root of a folder has a rule of
# its own, every sub-folder needs one.
macro(find_rule)
  string(REGEX MATCH "^[^/]+" top "${file}")
  string(REGEX MATCH "^[^/]+/[^/]+" rule "${file}")
  if(NOT file MATCHES "/.*/" AND DEFINED ${top}_root)
    set(rule ${top}_root)
  elseif(NOT DEFINED ${rule})
    set(rule ${top})
    if(DEFINED ${top}_root)
      violation("lies in a folder that is no room of ${top} (tests/architecture/include_rules.cmake)")
    endif()
  endif()
endmacro()

macro(check_own name)
  starts_with_one_of(allowed "${name}" ${${rule}})
  if(NOT allowed)
    violation("includes \"${name}\", but ${rule} may include only: ${${rule}}")
  elseif(NOT EXISTS "${ROOT}/${name}")
    violation("includes \"${name}\", which does not exist from the project's root")
  endif()
endmacro()

macro(check_third_party name)
  set(home "")
  set(parties ${third_parties})
  while(parties)
    list(POP_FRONT parties pattern folders)
    if("${name}" MATCHES "^(${pattern})")
      set(home "${folders}")
    endif()
  endwhile()
  if("${name}" MATCHES "${operating_system}")
    # The headers that wrap vector instructions may include immintrin.h, which is no system call.
    if(file MATCHES "\\.h$" AND NOT file MATCHES "^render/cpu/lanes_[a-z0-9]+\\.h$")
      violation("is a header and includes <${name}>: keep the operating system in .cpp files")
    endif()
  elseif(NOT home)
    violation("includes <${name}>, a third party that no folder declares (tests/architecture/include_rules.cmake)")
  elseif(NOT top MATCHES "^(${home})$" AND NOT rule MATCHES "^(${home})$")
    violation("includes <${name}>, which belongs to ${home}")
  elseif(file MATCHES "\\.h$")
    violation("is a header and includes <${name}>: keep third parties in .cpp files")
  endif()
endmacro()

set(files "")
foreach(folder calibration assets haptics render app tests)
  file(GLOB_RECURSE found RELATIVE "${ROOT}" "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp" "${ROOT}/${folder}/*.c")
  list(APPEND files ${found})
endforeach()

foreach(file IN LISTS files)
  find_rule()
  file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include")

  # A source includes its own header first, so that the header compiles by itself.
  string(REGEX REPLACE "\\.cpp$" ".h" own_header "${file}")
  if(NOT own_header STREQUAL file AND EXISTS "${ROOT}/${own_header}" AND NOT "${lines}" MATCHES "^#include \"${own_header}\"")
    violation("does not include \"${own_header}\" first: so that the header compiles by itself")
  endif()
  foreach(line IN LISTS lines)
    if(line MATCHES "include[ \t]*\"([^\"]+)\"")
      set(name "${CMAKE_MATCH_1}")
      if(NOT name MATCHES "^[a-z_]+\\.inc$")  # written by the build
        check_own("${name}")
      endif()
    elseif(line MATCHES "include[ \t]*<([^>]+)>")
      set(name "${CMAKE_MATCH_1}")
      # The standard library and GLM are free; tests may include any library.
      if(name MATCHES "[/.]" AND NOT name MATCHES "^glm/" AND NOT top STREQUAL "tests")
        check_third_party("${name}")
      endif()
    endif()
  endforeach()
endforeach()

list(LENGTH files count)
if(count EQUAL 0)
  message(FATAL_ERROR "no sources under ${ROOT}")
elseif(violations GREATER 0)
  message(FATAL_ERROR "${violations} includes against the rules in ${count} files")
endif()
message("${count} files keep the include rules")
