# other_formats.cmake: what reads and writes other programs' files, and reports: an installed library of readers, and the tools' own. Not built with
# BOUGH_TOOLS off.
find_package(pugixml REQUIRED)
find_package(assimp 5 REQUIRED)
find_package(TIFF REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenEXR 3.1 CONFIG REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED) # which says of each version that it stands for itself alone
if(meshoptimizer_VERSION VERSION_LESS 0.18)
  message(FATAL_ERROR "meshoptimizer is ${meshoptimizer_VERSION}: 0.18 or newer is needed")
endif()
find_path(BOUGH_STB stb/stb_image.h REQUIRED)

# Other programs' trees from bytes (c/bough_imports.h), a library that is installed too and needs pugixml beside. The readers are compiled once, for it and for
# the tools, whose own are of FBX, COLLADA and what meshoptimizer compressed: models/left_to_tools.cpp stands in the library for those.
file(GLOB importer_sources CONFIGURE_DEPENDS imports/*.cpp parameters/eztree.cpp parameters/parameter_table.cpp parameters/parameter_text.cpp models/armature*.cpp
  models/gltf_*.cpp models/model_gltf.cpp models/model_kind.cpp models/own_rods.cpp)
add_library(bough_importers OBJECT ${importer_sources})
target_link_libraries(bough_importers PRIVATE bough_files nlohmann_json::nlohmann_json pugixml::pugixml bough_flags)
set_target_properties(bough_importers PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_compile_options(bough_importers PRIVATE -fno-semantic-interposition) # its own functions are called as in a program
add_library(bough_imports SHARED $<TARGET_OBJECTS:bough_importers> models/left_to_tools.cpp)
add_library(bough::imports ALIAS bough_imports)
set_target_properties(bough_imports PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} EXPORT_NAME imports INSTALL_RPATH "$ORIGIN")
target_link_libraries(bough_imports PUBLIC bough_files PRIVATE $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> $<BUILD_INTERFACE:pugixml::pugixml> $<BUILD_INTERFACE:bough_flags>)
install(TARGETS bough_imports EXPORT boughTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(FILES c/bough_imports.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bough COMPONENT development)

# Other programs' files, meshes and reports.
file(GLOB format_sources CONFIGURE_DEPENDS models/*.cpp parameters/*.cpp exports/*.cpp reports/*.cpp)
list(REMOVE_ITEM format_sources ${importer_sources} ${CMAKE_CURRENT_SOURCE_DIR}/models/left_to_tools.cpp)
# What asks for headers of OpenEXR, libpng and meshoptimizer stands by itself: the others are compiled without them, and without their
# definitions, so that tools may share precompiled headers.
set(baking_sources ${CMAKE_CURRENT_SOURCE_DIR}/exports/data_image.cpp ${CMAKE_CURRENT_SOURCE_DIR}/exports/png_file.cpp ${CMAKE_CURRENT_SOURCE_DIR}/exports/simplified.cpp ${CMAKE_CURRENT_SOURCE_DIR}/models/meshopt.cpp)
list(REMOVE_ITEM format_sources ${baking_sources})
add_library(bough_baking STATIC ${baking_sources})
target_link_libraries(bough_baking PUBLIC bough_files PRIVATE nlohmann_json::nlohmann_json OpenEXR::OpenEXR PNG::PNG meshoptimizer::meshoptimizer bough_flags)
add_library(bough_formats STATIC $<TARGET_OBJECTS:bough_importers> ${format_sources})
target_link_libraries(bough_formats PUBLIC bough_files bough_study PRIVATE nlohmann_json::nlohmann_json pugixml::pugixml assimp::assimp TIFF::TIFF bough_baking bough_flags)
target_include_directories(bough_formats SYSTEM PRIVATE ${BOUGH_STB})
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang") # which works its parser out once, in the precompiled headers; GCC does so in each source that has them
  set(headers_of_documents <nlohmann/json.hpp>)
endif()
bough_precompile(bough_importers ${standard_headers} <Eigen/Core> <Eigen/Geometry> ${headers_of_documents})
bough_precompile(bough_formats ${standard_headers} <Eigen/Core> <Eigen/Geometry> ${headers_of_documents})
list(APPEND format_libraries bough_importers bough_imports bough_baking bough_formats)
target_link_options(bough_imports PRIVATE -Wl,-Bsymbolic-functions) # as of bough
if(NOT BOUGH_SANITIZE) # whose functions a program brings
  target_link_options(bough_imports PRIVATE -Wl,--no-undefined) # a reader that is left to the tools is told when it is linked, not when it is called
endif()

file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/bough_imports.pc "Name: bough_imports
Description: Trees of other programs for bough, for C, and beside bough for C++
Version: ${PROJECT_VERSION}
Requires: bough_c
Libs: -L\${pcfiledir}/.. -lbough_imports
")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/bough_imports.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
