# Defines the target esbuild, which bundles TypeScript.
find_program(DOTPOSE_ESBUILD esbuild)
mark_as_advanced(DOTPOSE_ESBUILD)
if(DOTPOSE_ESBUILD)
    add_executable(esbuild IMPORTED)
    set_target_properties(esbuild PROPERTIES IMPORTED_LOCATION ${DOTPOSE_ESBUILD})
endif()
