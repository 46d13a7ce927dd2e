# breakwater_add_plugin(NAME sources...): a plugin library that breakwater loads at run time by its bare name.
# Used inside the project and, through find_package(Breakwater), by plugins that live elsewhere.
function(breakwater_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES
    PREFIX "lib" CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(TARGET breakwater_core)
    target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE breakwater_core breakwater_flags)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${BREAKWATER_PLUGIN_OUTPUT_DIRECTORY})
    set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/../..")
    add_dependencies(breakwater_plugins ${name})
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/breakwater/plugins)
  else()
    target_link_libraries(${name} PRIVATE Breakwater::breakwater_core)
  endif()
endfunction()
