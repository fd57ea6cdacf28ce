# Makes the comment at the head of a header, below `#pragma once`, the page of that header. Its indented lines are
# formulas and tables, which stay as they are. The number of lines stays the same, for messages.
1s%^#pragma once%/// \\file%
2s%^$%///%
3,/^$/{
  s%^//    \( .*\)$%/// \\verbatim\1 \\endverbatim%
  s%^//%///%
  s%^////%///%
}
