// The editor of the program.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, indentService, indentUnit } from "@codemirror/language";
import { lintGutter, lintKeymap } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Compartment, EditorState, Transaction, type Extension } from "@codemirror/state";
import {
  EditorView,
  drawSelection,
  highlightActiveLine,
  highlightActiveLineGutter,
  keymap,
  lineNumbers,
} from "@codemirror/view";
import type { LSPClient } from "@codemirror/lsp-client";

import { element } from "../element";
import { nb } from "./language";

const look = EditorView.theme({
  "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--paper)", fontSize: "var(--code-size)" },
  "&.cm-focused": { outline: "none" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.55" },
  ".cm-content": { caretColor: "var(--ink)", padding: "10px 0" },
  ".cm-cursor": { borderLeftColor: "var(--ink)", borderLeftWidth: "2px" },
  ".cm-gutters": { backgroundColor: "var(--paper)", color: "var(--dim)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--highlight)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {
    backgroundColor: "var(--selection)",
  },
  ".cm-selectionMatch": { backgroundColor: "var(--highlight)" },
  "&.cm-focused .cm-matchingBracket": { backgroundColor: "var(--selection)" },
  ".cm-tooltip, .cm-panels": {
    backgroundColor: "var(--panel)",
    color: "var(--ink)",
    border: "1px solid var(--line)",
    borderRadius: "6px",
  },
  ".cm-tooltip": { maxWidth: "min(38rem, 92vw)", boxShadow: "0 4px 16px rgba(0,0,0,.18)" },
  ".cm-tooltip.cm-tooltip-hover": { maxHeight: "60vh", overflow: "auto" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--on-accent)" },
  ".cm-lsp-documentation": {
    fontFamily: "var(--font)",
    fontSize: "14px",
    "& pre": { fontFamily: "var(--mono)", whiteSpace: "pre-wrap" },
    "& img": { maxWidth: "100%", background: "#fff" },
  },
  ".cm-diagnostic": { fontFamily: "var(--font)", padding: "5px 10px" },
  ".cm-diagnostic-error": { borderLeft: "4px solid var(--bad)" },
  ".cm-lintRange-error": {
    backgroundImage: "none",
    textDecoration: "underline wavy var(--bad)",
    textUnderlineOffset: "3px",
  },
  ".cm-lintRange-warning": {
    backgroundImage: "none",
    textDecoration: "underline wavy var(--zero)",
    textUnderlineOffset: "3px",
  },
  ".cm-panel input, .cm-panel button": {
    font: "inherit",
    color: "inherit",
    backgroundColor: "var(--paper)",
    backgroundImage: "none",
    border: "1px solid var(--line)",
    borderRadius: "4px",
    padding: "3px 8px",
  },
});

const indentation = indentService.of(({ state, unit }, place) => {
  const { text, from } = state.doc.lineAt(place);
  const own = /^\s*/.exec(text)?.[0].length ?? 0;
  return own + (/[({]\s*$/.test(text.slice(0, place - from)) ? unit : 0);
});

export interface EditorEvents {
  changed: (text: string) => void;
  save: () => void;
}

export class Editor {
  readonly host = element("div", { class: "editor" });
  readonly #language = new Compartment();
  readonly #view: EditorView;
  #uri = "";
  #client: LSPClient | null = null;

  constructor(private readonly events: EditorEvents) {
    // In a tree of its own the editor's styles are style sheet objects, which no content policy forbids.
    const root = this.host.attachShadow({ mode: "open" });
    this.#view = new EditorView({ state: this.#state(""), parent: root, root });
    this.#view.dom.style.height = "100%";
  }

  get text(): string {
    return this.#view.state.doc.toString();
  }

  /** Shows a document from its start, without the undo history of the one before. */
  open(uri: string, text: string): void {
    this.#uri = uri;
    this.#view.setState(this.#state(text));
  }

  replace(text: string): void {
    this.#view.dispatch({ changes: { from: 0, to: this.#view.state.doc.length, insert: text } });
  }

  /** Inserts a declaration after the comment at the top of the file. */
  insertAtTop(line: string): void {
    const { doc } = this.#view.state;
    let number = 1;
    while (number <= doc.lines && /^\s*(\/\/.*|use\s.*)$/.test(doc.line(number).text)) {
      number++;
    }
    const next = number > doc.lines ? null : doc.line(number);
    const insert = `${number > 1 ? "\n" : ""}${line}\n${next !== null && next.length > 0 ? "\n" : ""}`;
    this.#view.dispatch({ changes: { from: next?.from ?? doc.length, insert }, scrollIntoView: true });
  }

  append(lines: string): void {
    const { doc } = this.#view.state;
    const before = doc.line(doc.lines).length === 0 ? "\n" : "\n\n";
    this.#view.dispatch({ changes: { from: doc.length, insert: `${before}${lines}\n` }, scrollIntoView: true });
  }

  reveal(line: number): void {
    const { doc } = this.#view.state;
    const { from, to } = doc.line(Math.min(doc.lines, Math.max(1, line)));
    this.#view.dispatch({
      selection: { anchor: from, head: to },
      effects: EditorView.scrollIntoView(from, { y: "center" }),
    });
    this.#view.focus();
  }

  serve(client: LSPClient | null): void {
    this.#client = client;
    this.#view.dispatch({ effects: this.#language.reconfigure([]) });
    this.#view.dispatch({ effects: this.#language.reconfigure(this.#plugin()) });
  }

  focus(): void {
    this.#view.focus();
  }

  #plugin(): Extension {
    return this.#client === null || this.#uri === "" ? [] : this.#client.plugin(this.#uri, "nb");
  }

  #state(text: string): EditorState {
    return EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(),
        highlightActiveLineGutter(),
        highlightActiveLine(),
        history(),
        drawSelection(),
        bracketMatching(),
        closeBrackets(),
        highlightSelectionMatches(),
        autocompletion(),
        lintGutter(),
        indentUnit.of("    "),
        indentation,
        nb(),
        look,
        EditorView.contentAttributes.of({ "aria-label": "The program" }),
        keymap.of([
          { key: "Mod-s", preventDefault: true, run: () => (this.events.save(), true) },
          ...closeBracketsKeymap,
          ...defaultKeymap,
          ...searchKeymap,
          ...historyKeymap,
          ...completionKeymap,
          ...lintKeymap,
          indentWithTab,
        ]),
        this.#language.of(this.#plugin()),
        EditorView.updateListener.of(update => {
          if (
            update.docChanged &&
            update.transactions.some(made => made.annotation(Transaction.addToHistory) !== false)
          ) {
            this.events.changed(update.state.doc.toString());
          }
        }),
      ],
    });
  }
}
