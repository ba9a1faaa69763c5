# Installs bough.py (formats/CMakeLists.txt): bough_python is the file, bough_python_folder where to, if not empty.
if(NOT bough_python_folder)
  find_program(bough_python3 python3 HINTS ${CMAKE_INSTALL_PREFIX}/bin)
  if(bough_python3)
    execute_process(COMMAND ${bough_python3} -c "
import pathlib, site, sys
prefix = pathlib.Path(sys.argv[1])
inside = [pathlib.Path(p) for p in site.getsitepackages() + [site.getusersitepackages()] if pathlib.Path(p).is_relative_to(prefix / 'lib')]
print(inside[0] if inside else prefix / f'lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages', end='')
" ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE bough_python_folder RESULT_VARIABLE bough_python_failed)
  endif()
  if(NOT bough_python3 OR bough_python_failed)
    set(bough_python_folder ${CMAKE_INSTALL_PREFIX}/share/bough)
  endif()
endif()
cmake_path(ABSOLUTE_PATH bough_python_folder BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX})
file(INSTALL ${bough_python} DESTINATION ${bough_python_folder})
