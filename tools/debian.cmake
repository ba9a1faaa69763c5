# Debian packages by CPack: one for the tools, one for the libraries, one for who builds upon them, one for Python,
# and one for the page where it is there. tools/debian makes them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME bough)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "bough's authors <bough@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL tools library development python)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib ${PROJECT_BINARY_DIR}/formats)
set(same "(= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME bough)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "trees that move like wood: treegen, treeconvert, treesim, treeprofile
 They build or import trees, segment them into rigid bodies, simulate them in
 wind, write JSON, OBJ, point caches and animated glTF, and measure error and cost.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "libbough0 ${same}")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "gnuplot-nox, f3d, imagemagick")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libbough0)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "trees that move like wood: the libraries")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/triggers)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbough-dev)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "trees that move like wood: headers for C++ and C, CMake and pkg-config files")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libbough0 ${same}, libeigen3-dev")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-bough)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "trees that move like wood: the Python module")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "libbough0 (>= ${PROJECT_VERSION}), python3, python3-numpy")
# What Python wrote when root imported the module is no file of a package's: it goes before the module does.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/prerm "#!/bin/sh\nset -e\nrm -f /usr/lib/python3/dist-packages/__pycache__/bough.cpython-*.pyc\n")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)

if(BOUGH_PAGE)
  list(APPEND CPACK_COMPONENTS_ALL page)
  set(CPACK_DEBIAN_PAGE_PACKAGE_NAME bough-live)
  set(CPACK_COMPONENT_PAGE_DESCRIPTION "trees that move like wood: the page in which a tree is pulled by hand
 bough-live serves it to this machine alone.")
  set(CPACK_DEBIAN_PAGE_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_PAGE_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PAGE_PACKAGE_DEPENDS "python3")
endif()

include(CPack)
