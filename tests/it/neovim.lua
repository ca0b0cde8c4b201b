-- What a user of Neovim does, by its own client: run with `nvim --headless -u NONE -c 'luafile …'` in a folder with
-- `latch.nb`; the results are written to `found.json`.
local found = {}
local buffer = vim.fn.bufadd("latch.nb")
vim.fn.bufload(buffer)
vim.api.nvim_set_current_buf(buffer)
local client = vim.lsp.start_client({ name = "nbc", cmd = { vim.env.NBC, "lsp" }, root_dir = vim.fn.getcwd() })
vim.lsp.buf_attach_client(buffer, client)

local function place(line, character)
  return {
    textDocument = vim.lsp.util.make_text_document_params(buffer),
    position = { line = line, character = character },
  }
end

local function ask(method, params)
  local answers = vim.lsp.buf_request_sync(buffer, method, params, 20000)
  return answers[client] and answers[client].result
end

vim.wait(20000, function() return vim.lsp.buf_is_attached(buffer, client) and vim.lsp.get_client_by_id(client).initialized end)
local line = tonumber(vim.env.LINE)
local character = tonumber(vim.env.CHARACTER)
found.hover = ask("textDocument/hover", place(line, character)).contents.value
found.definition = ask("textDocument/definition", place(line, character)).range.start.line
local robot = vim.fn.searchpos("nand(", "nw")
found.robot = ask("textDocument/hover", place(robot[1] - 1, robot[2] - 1)).contents.value
found.highlights = #ask("textDocument/documentHighlight", place(line, character))
found.symbols = #ask("textDocument/documentSymbol", place(0, 0))
found.workspace = #ask("workspace/symbol", { query = "d_latch" })
found.completions = #ask("textDocument/completion", place(0, 0))
local lenses = ask("textDocument/codeLens", place(0, 0))
for _, lens in ipairs(lenses) do
  if lens.command.title == "run as logic" and not found.ran then
    local command = { command = lens.command.command, arguments = lens.command.arguments }
    found.ran = ask("workspace/executeCommand", command)
    -- The page ends with the server.
    found.page = table.concat(vim.fn.readfile(found.ran.path), "\n")
  end
end
local rename = place(line, character)
rename.newName = "memory"
vim.lsp.util.apply_workspace_edit(ask("textDocument/rename", rename), vim.lsp.get_client_by_id(client).offset_encoding)
vim.api.nvim_buf_set_lines(buffer, 0, 0, false, { "//   formatted", "" })
local format = { textDocument = place(0, 0).textDocument, options = { tabSize = 4, insertSpaces = true } }
local edits = ask("textDocument/formatting", format)
vim.lsp.util.apply_text_edits(edits, buffer, vim.lsp.get_client_by_id(client).offset_encoding)
found.text = table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), "\n") .. "\n"
found.problems = #vim.diagnostic.get(buffer)
local call = "    (q, _) = memory(d, "
vim.api.nvim_buf_set_lines(buffer, -1, -1, false, { "circuit held(d, e) -> (q) {", call })
local help = ask("textDocument/signatureHelp", place(vim.api.nvim_buf_line_count(buffer) - 1, #call))
found.signature = table.concat(vim.lsp.util.convert_signature_help_to_markdown_lines(help, "nb", { "(", "," }), "\n")
vim.fn.writefile({ vim.fn.json_encode(found) }, "found.json")
vim.cmd("qall!")
