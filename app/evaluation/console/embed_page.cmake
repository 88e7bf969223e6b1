# Writes the page's files as C++ to embed. Run: cmake -DFOLDER=… -DOUT=… -DFILES=a.html,b.js -P embed_page.cmake
cmake_minimum_required(VERSION 3.25)

string(REPLACE "," ";" files "${FILES}")
set(entries "")
foreach(file IN LISTS files)
  file(READ "${FOLDER}/${file}" text)
  string(APPEND entries "    {\"${file}\", R\"molar_page(${text})molar_page\"},\n")
endforeach()
file(WRITE "${OUT}" "${entries}")
