# SPDX-License-Identifier: GPL-3.0-or-later
# Makes and installs the man page and the completions for shells, from what the programs tell of their command lines.
find_program(LODESTONE_DOCUMENTS_PYTHON python3)
set(documents_folder ${PROJECT_BINARY_DIR}/documents)
if(LODESTONE_DOCUMENTS_PYTHON AND NOT CMAKE_CROSSCOMPILING)
  set(man_page ${documents_folder}/lodestone.1)
  set(bash_completion ${documents_folder}/lodestone)
  set(zsh_completion ${documents_folder}/_lodestone)
  add_custom_command(OUTPUT ${man_page} ${bash_completion} ${zsh_completion}
    COMMAND ${LODESTONE_DOCUMENTS_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/document_program ${documents_folder}
            $<TARGET_FILE:lodestone_program> $<TARGET_FILE:lodestone_experiments>
    DEPENDS lodestone_program lodestone_experiments ${PROJECT_SOURCE_DIR}/scripts/document_program
    COMMENT "Making the man page and the completions")
  add_custom_target(lodestone_documents ALL DEPENDS ${man_page} ${bash_completion} ${zsh_completion})
  install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${bash_completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES ${zsh_completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
else()
  message(STATUS "Without man page and completions: they need Python, and a program that can be run here")
endif()
