-- Expressions over tables of results, which the numbers and the claims of the text are made of.
--
--   table_5_3_so_synthesis[workspace=P1 optimizer=dynamic_q formulation=area].f_star      a field of a single row
--   f_star - published_f_star                                                            columns of the row at hand
--   count(T[conditions])       how many rows          count(T[...], test)     how many of them meet a test
--   all(T[...], test)          any(T[...], test)      min, max, sum, mean, median(T[...], expression)
--   distinct(T[...], expression)                      how many different values
--   setting('table_5_3_so_synthesis', '--chord')      an option of the run
--   constant('reference_optimum', 'outline_samples')  a number that is built into the program
--   abs(x), sqrt(x), log10(x), round(x, digits), largest(x, y, ...), smallest(x, y, ...)
--
-- with + - * /, = != < <= > >=, and, or, not, 'texts', and names that a block {.define} of the report gives to longer
-- expressions. In the expression after a table, names are its columns. A condition is column=text, where the text is
-- compared as it is written, or column!=text, or column<number and the like, or column=(expression) with the columns of
-- the row outside. A sum over nothing is 0; a smallest or a middle of nothing stops the build. An empty field is a text.

local records = require "records"
local manifest = require "manifest"
local support = require "support"
local tables = require "tables"

local expressions = {}
local definitions = {}

local function fail(source, ...)
  support.fail("the expression '%s' %s.", source, string.format(...))
end

-- The signs of an expression: {kind, text}. A table's conditions are one sign.
local function signs(source)
  local found, i = {}, 1
  while true do
    i = source:find("%S", i)
    if not i then return found end
    local function take(kind, pattern)
      local first, last, text = source:find("^(" .. pattern .. ")", i)
      if not first then return false end
      found[#found + 1] = {kind, text}
      i = last + 1
      return true
    end
    if not (take("number", "%d+%.?%d*[eE][+-]?%d+") or take("number", "%d+%.?%d*") or take("text", "'[^']*'") or
        take("name", "published/[%w_]+") or take("name", "[%a_][%w_]*") or take("conditions", "%b[]") or
        take("sign", "[!<>]=") or take("sign", "[-+*/=<>(),.]")) then
      fail(source, "is not understood at '%s'", source:sub(i, i + 10))
    end
  end
end

local function numeric(source, value)
  return tonumber(value) or fail(source, "takes '%s' for a number", tostring(value))
end

local function compare(source, operator, left, right)
  if operator == "=" or operator == "!=" then
    local same
    if tonumber(left) and tonumber(right) then same = tonumber(left) == tonumber(right) else same = left == right end
    return same == (operator == "=")
  end
  left, right = numeric(source, left), numeric(source, right)
  if operator == "<" then return left < right end
  if operator == "<=" then return left <= right end
  if operator == ">" then return left > right end
  return left >= right
end

local function truth(source, value)
  if type(value) ~= "boolean" then fail(source, "takes '%s' for true or false", tostring(value)) end
  return value
end

local function median(values)
  table.sort(values)
  local middle = #values // 2
  return #values % 2 == 1 and values[middle + 1] or (values[middle] + values[middle + 1]) / 2
end

local reductions = {
  min = function(values) return math.min(table.unpack(values)) end,
  max = function(values) return math.max(table.unpack(values)) end,
  median = median,
  mean = function(values)
    local sum = 0
    for _, value in ipairs(values) do sum = sum + value end
    return sum / #values
  end,
}

local aggregates = {count = true, all = true, any = true, distinct = true, sum = true, min = true, max = true,
  median = true, mean = true}

-- What the record of a run holds.
local recorded = {setting = records.option, constant = records.constant}

local functions = {
  abs = math.abs, sqrt = math.sqrt,
  log10 = function(x) return math.log(x, 10) end,
  largest = math.max, smallest = math.min,
  round = function(x, digits)
    local unit = 10.0 ^ -(digits or 0)
    return math.floor(x / unit + 0.5) * unit
  end,
}

local compile

-- The conditions "column=text column<number" as a list of {column, operator, value}; the value is a text or a function
-- of the row outside.
local function read_conditions(source, text)
  local list, i = {}, 1
  while true do
    i = text:find("%S", i)
    if not i then return list end
    local column, operator, stop = text:match("^([%w_]+)([!<>]?=)()", i)
    if not column then column, operator, stop = text:match("^([%w_]+)([<>])()", i) end
    if not column then support.fail("'%s' is not a condition such as workspace=P1.", text:match("%S+", i)) end
    local value, last = text:match("^(%b())()", stop)
    if value then
      value = compile(value:sub(2, -2))
    else
      value, last = text:match("^'([^']*)'()", stop)
      if not value then value, last = text:match("^(%S*)()", stop) end
    end
    list[#list + 1] = {column, operator, value}
    i = last
  end
end

local function meets(source, loaded, row, condition, scope)
  local column, operator, value = table.unpack(condition)
  local text = row[tables.need(loaded, column)]
  if type(value) == "function" then return compare(source, operator, text, value(scope)) end
  if operator == "=" then return text == value end
  if operator == "!=" then return text ~= value end
  return text ~= "" and compare(source, operator, text, value)
end

-- The rows of a table that meet all of the conditions "column=text column<number".
function expressions.select(loaded, conditions, scope)
  local list = read_conditions(conditions, conditions)
  local rows = {}
  for _, row in ipairs(loaded.rows) do
    local kept = true
    for _, condition in ipairs(list) do kept = kept and meets(conditions, loaded, row, condition, scope) end
    if kept then rows[#rows + 1] = row end
  end
  return rows
end

-- Compiles an expression into a function of a scope: nothing, or the row at hand with its table.
function compile(source)
  local list, at = signs(source), 1
  local function peek(text) return list[at] and (not text or list[at][2] == text) and list[at] end
  local function accept(text)
    if peek(text) and list[at][1] ~= "text" then
      at = at + 1
      return true
    end
  end
  local function expect(text) return accept(text) or fail(source, "lacks '%s'", text) end
  local expression

  -- A table and its conditions, as a function of the scope that returns the table and its rows.
  local function table_reference()
    local sign = list[at]
    if not sign or sign[1] ~= "name" then fail(source, "lacks the name of a table") end
    at = at + 1
    local conditions = ""
    if peek() and list[at][1] == "conditions" then
      conditions = list[at][2]:sub(2, -2)
      at = at + 1
    end
    return function(scope)
      local loaded = tables.load(sign[2])
      return loaded, expressions.select(loaded, conditions, scope), conditions
    end
  end

  local function over_rows(name)
    local rows_of = table_reference()
    local inner = accept(",") and expression()
    expect(")")
    if not inner and name ~= "count" then fail(source, "lacks what '%s' is taken of", name) end
    return function(scope)
      local loaded, rows = rows_of(scope)
      local values = {}
      for i, row in ipairs(rows) do values[i] = inner and inner({row = row, table = loaded}) end
      if name == "count" or name == "all" or name == "any" then
        local number = 0
        for i = 1, #rows do
          if not inner or truth(source, values[i]) then number = number + 1 end
        end
        if name == "count" then return number end
        if #rows == 0 then fail(source, "asks about rows of '%s', which has none such", loaded.name) end
        return name == "all" and number == #rows or name == "any" and number > 0
      elseif name == "distinct" then
        local known, number = {}, 0
        for _, value in ipairs(values) do
          if not known[value] then known[value], number = true, number + 1 end
        end
        return number
      end
      for i, value in ipairs(values) do values[i] = numeric(source, value) end
      if name == "sum" then
        local sum = 0
        for _, value in ipairs(values) do sum = sum + value end
        return sum
      end
      if #values == 0 then fail(source, "takes '%s' of no rows of '%s'", name, loaded.name) end
      return reductions[name](values)
    end
  end

  local function single_field()
    local rows_of = table_reference()
    expect(".")
    local column = peek() and list[at][1] == "name" and list[at][2] or fail(source, "lacks a column after the dot")
    at = at + 1
    return function(scope)
      local loaded, rows, conditions = rows_of(scope)
      tables.need(loaded, column)
      if #rows == 0 then support.fail("the table '%s' has no row with %s.", loaded.name, conditions) end
      if #rows > 1 then fail(source, "means %d rows of '%s', but must mean one", #rows, loaded.name) end
      return rows[1][column]
    end
  end

  local function primary()
    local sign = list[at] or fail(source, "ends too early")
    local kind, text = table.unpack(sign)
    local after = list[at + 1]
    if kind == "number" then
      at = at + 1
      return function() return tonumber(text) end
    elseif kind == "text" then
      at = at + 1
      return function() return text:sub(2, -2) end
    elseif accept("(") then
      local inner = expression()
      expect(")")
      return inner
    elseif accept("-") then
      local inner = primary()
      return function(scope) return -numeric(source, inner(scope)) end
    elseif kind ~= "name" then
      fail(source, "has '%s' where a value is needed", text)
    elseif after and after[2] == "(" and aggregates[text] then
      at = at + 2
      return over_rows(text)
    elseif after and after[2] == "(" and recorded[text] then
      at = at + 2
      local program = expression()
      expect(",")
      local name = expression()
      expect(")")
      return function(scope) return recorded[text](manifest.program_of(program(scope)), name(scope)) end
    elseif after and after[2] == "(" then
      local called = functions[text] or fail(source, "calls '%s', which is no function", text)
      at = at + 2
      local arguments = {expression()}
      while accept(",") do arguments[#arguments + 1] = expression() end
      expect(")")
      return function(scope)
        local values = {}
        for i, argument in ipairs(arguments) do values[i] = numeric(source, argument(scope)) end
        return called(table.unpack(values))
      end
    elseif after and (after[1] == "conditions" or after[2] == ".") then
      return single_field()
    end
    at = at + 1
    return function(scope)
      if scope and scope.table.columns[text] then return scope.row[text] end
      if definitions[text] then return definitions[text].value() end
      if scope then tables.need(scope.table, text) end
      fail(source, "has the name '%s', which is neither defined nor a column", text)
    end
  end

  local function chain(operand, operators, combine)
    return function()
      local left = operand()
      while peek() and list[at][1] ~= "text" and operators[list[at][2]] do
        local operator = list[at][2]
        at = at + 1
        local first, second = left, operand()
        left = function(scope) return combine(operator, first, second, scope) end
      end
      return left
    end
  end
  local function arithmetic(operator, first, second, scope)
    local left, right = numeric(source, first(scope)), numeric(source, second(scope))
    if operator == "+" then return left + right end
    if operator == "-" then return left - right end
    if operator == "*" then return left * right end
    return left / right
  end
  local product = chain(primary, {["*"] = true, ["/"] = true}, arithmetic)
  local sum = chain(product, {["+"] = true, ["-"] = true}, arithmetic)
  local comparison = chain(sum, {["="] = true, ["!="] = true, ["<"] = true, ["<="] = true, [">"] = true, [">="] = true},
    function(operator, first, second, scope) return compare(source, operator, first(scope), second(scope)) end)
  local function negation()
    if accept("not") then
      local inner = negation()
      return function(scope) return not truth(source, inner(scope)) end
    end
    return comparison()
  end
  local conjunction = chain(negation, {["and"] = true}, function(_, first, second, scope)
    return truth(source, first(scope)) and truth(source, second(scope))
  end)
  expression = chain(conjunction, {["or"] = true}, function(_, first, second, scope)
    return truth(source, first(scope)) or truth(source, second(scope))
  end)

  local compiled = expression()
  if list[at] then fail(source, "is not understood at '%s'", list[at][2]) end
  return compiled
end

local compiled = {}

-- The value of an expression: a number, a text, true or false; for a row of a table, or with no row at hand.
function expressions.value(source, loaded, row)
  compiled[source] = compiled[source] or compile(source)
  return compiled[source](loaded and {table = loaded, row = row})
end

function expressions.holds(source) return truth(source, expressions.value(source)) end

-- Gives a name to an expression.
function expressions.define(name, source)
  local known = compile(source)
  definitions[name] = {source = source, value = function() return known() end}
end

-- An expression that is a single defined name, with what it stands for.
function expressions.spelled_out(source)
  return definitions[source] and source .. " = " .. definitions[source].source or source
end

-- The columns of a table that an expression over its rows names.
function expressions.columns(source, loaded)
  local found = {}
  for _, sign in ipairs(signs(source)) do
    if sign[1] == "name" and loaded.columns[sign[2]] then found[#found + 1] = sign[2] end
  end
  return found
end

-- Whether the sign at place i names a table.
local function names_table(list, i)
  local before, after = list[i - 1], list[i + 1]
  local called = before and before[2] == "(" and list[i - 2] and aggregates[list[i - 2][2]]
  return list[i][1] == "name" and (called or after and (after[1] == "conditions" or after[2] == ".")) and true or false
end

-- All columns that an expression takes values from, each as {table, column}; `loaded` is the table whose row is at hand.
function expressions.fields(source, loaded)
  local found, known, named = {}, {}, {loaded}
  local function search(list)
    for i, sign in ipairs(list) do
      local name = sign[1] == "name" and sign[2]
      if name and definitions[name] then
        search(signs(definitions[name].source))
      elseif name and names_table(list, i) then
        table.insert(named, 1, tables.load(name))
      elseif name then
        for _, candidate in ipairs(named) do
          if candidate.columns[name] then
            if not known[candidate.name .. "." .. name] then found[#found + 1] = {candidate, name} end
            known[candidate.name .. "." .. name] = true
            break
          end
        end
      end
    end
  end
  search(signs(source))
  return found
end

-- The first table that an expression names; its conditions and the column too when it is a field of a single row.
function expressions.origin(source)
  local list = signs(source)
  for i, sign in ipairs(list) do
    local after = list[i + 1]
    if sign[1] == "name" and definitions[sign[2]] then return expressions.origin(definitions[sign[2]].source) end
    if names_table(list, i) then
      local conditions = after and after[1] == "conditions" and after[2]:sub(2, -2) or ""
      local column = list[#list - 1] and list[#list - 1][2] == "." and #list <= 4 and list[#list][2] or nil
      return sign[2], column, conditions
    end
  end
end

return expressions
