"""Cards that ask for results, the same in every scene; `output` is the interval of field states."""

REQUESTS = """\
*DATABASE_BINARY_D3PLOT
$#      dt
${output:10}
*DATABASE_GLSTAT
$#      dt
${output / 10:10}
*DATABASE_MATSUM
$#      dt
${output / 10:10}
"""
