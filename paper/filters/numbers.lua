-- Numbers and names as people write them.

local support = require "support"

local numbers = {}

local raised = {["-"] = "⁻", ["0"] = "⁰", ["1"] = "¹", ["2"] = "²", ["3"] = "³", ["4"] = "⁴", ["5"] = "⁵", ["6"] = "⁶",
  ["7"] = "⁷", ["8"] = "⁸", ["9"] = "⁹"}

-- A raised sign and the sign it raises.
numbers.lowered = {}
for digit, sign in pairs(raised) do numbers.lowered[sign] = digit == "-" and "−" or digit end

local words = {[0] = "none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven",
  "twelve"}

-- A true minus sign, and powers of ten in place of an exponent, except for zero. The format is one of string.format, or
-- `word` for small whole numbers as words, `Word` at the beginning of a sentence.
function numbers.format(format, number)
  if format:lower() == "word" then
    local word = words[number] or string.format("%d", number)
    return format == "Word" and word:gsub("^%l", string.upper) or word
  end
  if format:match("d$") then
    number = math.tointeger(number) or support.fail("'%s' is not a whole number.", number)
  end
  if number == 0 and format:match("e$") then return "0" end
  local text = string.format(format, number)
  local mantissa, exponent = text:match("^(.-)[eE]([+-]%d+)$")
  if mantissa then
    exponent = tostring(math.tointeger(tonumber(exponent))):gsub(".", raised)
    text = mantissa == "1" and "10" .. exponent or mantissa .. "\u{a0}×\u{a0}10" .. exponent
  end
  return (text:gsub("%-", "−"))
end

-- The value of an option.
function numbers.option(value, format)
  if type(value) == "number" then return numbers.format(format or "%.6g", value) end
  if type(value) ~= "table" then return tostring(value) end
  local items = {}
  for i, item in ipairs(value) do items[i] = numbers.option(item, format) end
  return table.concat(items, ", ")
end

-- The value of an option as one types it: a negative number would be taken for an option after a blank.
function numbers.typed(name, value)
  if value == true then return name end
  local function text(item) return type(item) == "number" and string.format("%.12g", item) or tostring(item) end
  if type(value) == "table" then
    local items = {}
    for i, item in ipairs(value) do items[i] = text(item) end
    value = table.concat(items, ",")
  end
  value = text(value)
  if value == "" or value:match("[^%w_.,:/+-]") then value = "'" .. value .. "'" end
  return value:match("^%-") and name .. "=" .. value or name .. " " .. value
end

local names

-- What people call a thing that has this name in the results, or nothing: data/names.csv, as for the pictures.
local function shown(name)
  if not names then
    names = {}
    for line in support.read(support.source .. "/data/names.csv"):gmatch("[^\n]+") do
      local fields = support.split_line(line)
      if not line:match("^#") then names[fields[1]] = fields[2] end
    end
  end
  return names[name]
end

local symbols = {N_g = "N^g", N_f = "N^f", f_d0 = "f(\\mathbf{d}^0)", ["f(d^0)"] = "f(\\mathbf{d}^0)", f_star = "f^*",
  ["f*"] = "f^*", g_star = "g^*", ["g*"] = "g^*", n_b = "n_b", kappa_inverse = "\\kappa^{-1}",
  kappa_inv_dense = "\\kappa^{-1}", d = "\\mathbf{d}", length = "length"}

-- A name with a hyphen stays on one line.
function numbers.name(text)
  local symbol, found = text:gsub("%f[%a](%a_%a)%f[%A]", "$%1$")
  local name = support.inlines(shown(text) or (found > 0 and symbol or text:gsub("_", " ")))
  return name:walk {
    Str = function(str)
      if str.text:match("%a%-%a") then return pandoc.Span({str}, pandoc.Attr("", {"unbroken"})) end
    end,
  }
end

-- The symbol of a quantity, or nothing for a name that is none.
function numbers.symbol(text) return symbols[text] or text:match("^%a[_^][%a*]$") or text:match("^[%a]$") end

return numbers
