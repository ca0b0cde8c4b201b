// Highlighting of nb, for the time before the language server has answered.

import {
  HighlightStyle,
  LanguageSupport,
  StreamLanguage,
  syntaxHighlighting,
  type StringStream,
} from "@codemirror/language";
import { tags } from "@lezer/highlight";

const DECLARATIONS =
  /^(circuit|environment|enum|let|file|prove|test|images|material|evolution|library|swarm|world|schedule|simulate|stimulus)\b/;
const WORDS = /^(if|then|else|for|in|init|net|table|match|repeat|until|log2|use|with|all|inputs|against|ever|once)\b/;
const OPERATORS = /^(and|or|xor|nand|nor|xnor|not)\b(?!\()/;
const UNITS = /^(steps?|cycles?|seconds?|ms|milliseconds|deg|degrees?|bins)\b/;

interface State {
  declares: boolean;
}

function token(stream: StringStream, state: State): string | null {
  if (stream.eatSpace()) {
    return null;
  }
  if (stream.match("//")) {
    stream.skipToEnd();
    return "comment";
  }
  if (stream.match(/^"[^"]*"?/)) {
    return "string";
  }
  if (state.declares && stream.match(/^[A-Za-z_]\w*/)) {
    state.declares = false;
    return "definition";
  }
  if (stream.match(DECLARATIONS)) {
    // Only at the start of a line: `circuit:` is a field, too.
    const declares = !stream.match(/^\s*:/, false);
    state.declares = declares;
    return declares ? "keyword" : "property";
  }
  state.declares = false;
  return plainToken(stream);
}

function plainToken(stream: StringStream): string | null {
  if (stream.match(/^\w+'[bdh]\w*/) || stream.match(/^\d+(\.\d+)?/)) {
    return "number";
  }
  if (stream.match(/^[A-Za-z_]\w*(?=\s*:)/)) {
    return "property";
  }
  if (stream.match(WORDS)) {
    return "keyword";
  }
  if (stream.match(OPERATORS)) {
    return "operatorKeyword";
  }
  if (stream.match(UNITS)) {
    return "unit";
  }
  if (stream.match(/^[A-Za-z_]\w*(?=(\[[^\]]*\])?\()/)) {
    return "call";
  }
  if (stream.match(/^[A-Za-z_]\w*/)) {
    return "variable";
  }
  if (stream.match(/^(->|==|!=|<=|>=|\*\*|\.\.|[-+*/%<>=|^:,])/)) {
    return "operator";
  }
  stream.next();
  return null;
}

export const nbLanguage = StreamLanguage.define<State>({
  name: "nb",
  startState: () => ({ declares: false }),
  copyState: state => ({ ...state }),
  token,
  languageData: { commentTokens: { line: "//" }, closeBrackets: { brackets: ["(", "[", "{", '"'] } },
  tokenTable: {
    definition: tags.definition(tags.function(tags.name)),
    call: tags.function(tags.name),
    property: tags.propertyName,
    operatorKeyword: tags.operatorKeyword,
    unit: tags.unit,
  },
});

const style = HighlightStyle.define([
  { tag: tags.comment, color: "var(--syntax-comment)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--syntax-string)" },
  { tag: tags.number, color: "var(--syntax-number)" },
  { tag: tags.keyword, color: "var(--syntax-keyword)", fontWeight: "600" },
  { tag: tags.operatorKeyword, color: "var(--syntax-operator)" },
  { tag: tags.operator, color: "var(--dim)" },
  { tag: tags.unit, color: "var(--dim)" },
  { tag: tags.propertyName, color: "var(--syntax-property)" },
  { tag: tags.definition(tags.function(tags.name)), color: "var(--syntax-definition)", fontWeight: "600" },
  { tag: tags.function(tags.name), color: "var(--syntax-definition)" },
]);

export function nb(): LanguageSupport {
  return new LanguageSupport(nbLanguage, syntaxHighlighting(style));
}
