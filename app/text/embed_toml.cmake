# Writes shipped TOML files as C++ to embed. Run: cmake -DFOLDER=… -DOUT=… -DFILES=a.toml,b.toml -P embed_toml.cmake
cmake_minimum_required(VERSION 3.25)

string(REPLACE "," ";" files "${FILES}")
set(entries "")
foreach(file IN LISTS files)
  file(READ "${FOLDER}/${file}" text)
  string(REPLACE "_" "-" name "${file}")
  string(REPLACE ".toml" "" name "${name}")
  string(APPEND entries "    {\"${name}\", R\"toml(${text})toml\"},\n")
endforeach()
file(WRITE "${OUT}" "${entries}")
