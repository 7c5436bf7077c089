# SPDX-License-Identifier: Apache-2.0
# cmake -DSOURCE=… -DBUILD=… -P links_test.cmake: checks that toolchains/site/links.py accepts a sound site, and reports
# each kind of broken link.
find_program(python NAMES python3)
if(NOT python)
  message(STATUS "SKIPPED: python3 is not installed")
  return()
endif()
set(site "${BUILD}/tests/links_site")

# Writes a site whose start page has the body, and runs links.py. Sets `result` and `said`.
function(check body)
  file(REMOVE_RECURSE "${site}")
  file(WRITE "${site}/index.html" "<h1 id='top'>x</h1>${body}")
  file(WRITE "${site}/docs/page.html" "<a href='../index.html#top'>x</a><h2 id='a-b'>x</h2>")
  file(WRITE "${site}/site.css" "body { background: url(docs/page.html) }")
  execute_process(COMMAND "${python}" "${SOURCE}/toolchains/site/links.py" "${site}"
    RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE said)
  set(result "${result}" PARENT_SCOPE)
  set(said "${said}" PARENT_SCOPE)
  set(out "${out}" PARENT_SCOPE)
endfunction()

check("<a href='docs/page.html#a-b'>x</a><a href='#top'>x</a><a href='https://example.org/'>x</a><img src='data:,'>")
if(NOT result EQUAL 0 OR NOT out MATCHES "\nhttps://example.org/\n6 links in 3 pages")
  message(FATAL_ERROR "a sound site: expected 6 links and no error, found ${result}: ${out}${said}")
endif()
foreach(wrong "docs/none.html|names a file that does not exist" "docs/page.html#none|names an anchor that does not exist"
    "#none|names an anchor that does not exist" "/docs/page.html|is not relative" "../tests|leaves the site")
  string(REPLACE "|" ";" wrong "${wrong}")
  list(GET wrong 0 link)
  list(GET wrong 1 problem)
  check("<a href='${link}'>x</a>")
  if(NOT result EQUAL 1 OR NOT said MATCHES "index.html: ${link} ${problem}")
    message(FATAL_ERROR "${link}: expected '${problem}', found result ${result}: ${said}")
  endif()
endforeach()
check("<img src='https://example.org/a.png'>")
if(NOT result EQUAL 1 OR NOT said MATCHES "loads from another site")
  message(FATAL_ERROR "a picture of another site: expected an error, found result ${result}: ${said}")
endif()
file(REMOVE_RECURSE "${site}")
