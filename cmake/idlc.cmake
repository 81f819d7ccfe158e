# Finds the IDL compiler for the messages that `dotpose watch --dds` publishes.
find_program(DOTPOSE_IDLC idlc)
if(DOTPOSE_IDLC)
    add_executable(CycloneDDS::idlc IMPORTED)
    set_target_properties(CycloneDDS::idlc PROPERTIES IMPORTED_LOCATION ${DOTPOSE_IDLC})
endif()
