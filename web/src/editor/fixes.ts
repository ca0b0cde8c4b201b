// Quick fixes of the language server: as buttons in what is said of a mistake, as a sign beside its line, and as a list
// at the cursor.

import {
  forEachDiagnostic,
  setDiagnostics,
  setDiagnosticsEffect,
  type Action,
  type Diagnostic,
} from "@codemirror/lint";
import { LSPPlugin } from "@codemirror/lsp-client";
import { Annotation, StateEffect, StateField, type EditorState, type Extension, type Text } from "@codemirror/state";
import {
  EditorView,
  GutterMarker,
  ViewPlugin,
  gutter,
  keymap,
  showTooltip,
  type Tooltip,
  type ViewUpdate,
} from "@codemirror/view";

import { button, element } from "../element";

interface Position {
  line: number;
  character: number;
}

interface Range {
  start: Position;
  end: Position;
}

interface CodeAction {
  title: string;
  diagnostics?: { range: Range; message: string }[];
  edit?: { changes?: Record<string, { range: Range; newText: string }[]> };
}

const complete = Annotation.define<boolean>();

/** Asks for the fixes of diagnostics as soon as these arrive. */
const asking = ViewPlugin.fromClass(
  class {
    update({ view, transactions }: ViewUpdate): void {
      const arrived = transactions.some(
        made => made.annotation(complete) !== true && made.effects.some(effect => effect.is(setDiagnosticsEffect)),
      );
      if (arrived) {
        // Without an answer the diagnostics stay as they are.
        addFixes(view).catch(() => {});
      }
    }
  },
);

async function addFixes(view: EditorView): Promise<void> {
  const plugin = LSPPlugin.get(view);
  const { doc } = view.state;
  if (plugin === null || diagnosticsOf(view.state).length === 0 || !plugin.unsyncedChanges.empty) {
    return;
  }
  const actions = await plugin.client.request<object, CodeAction[] | null>("textDocument/codeAction", {
    textDocument: { uri: plugin.uri },
    range: { start: plugin.toPosition(0), end: plugin.toPosition(doc.length) },
    context: { diagnostics: [] },
  });
  if (!view.state.doc.eq(doc)) {
    return;
  }
  const fixed = diagnosticsOf(view.state).map((found): Diagnostic => {
    const own = (actions ?? []).filter(action =>
      action.diagnostics?.some(
        ({ range, message }) => message === found.message && plugin.fromPosition(range.start, doc) === found.from,
      ),
    );
    return { ...found, actions: own.flatMap(action => actionOf(action, plugin, doc)) };
  });
  view.dispatch({ ...setDiagnostics(view.state, fixed), annotations: complete.of(true) });
}

function actionOf({ title, edit }: CodeAction, plugin: LSPPlugin, doc: Text): Action[] {
  const edits = Object.entries(edit?.changes ?? {});
  const own = edits.find(([uri]) => decodeURI(uri) === decodeURI(plugin.uri))?.[1];
  if (own === undefined || edits.length > 1) {
    return [];
  }
  const changes = own.map(({ range, newText }) => ({
    from: plugin.fromPosition(range.start, doc),
    to: plugin.fromPosition(range.end, doc),
    insert: newText,
  }));
  // After another edit the places are wrong, and new diagnostics are on their way.
  const apply = (view: EditorView): void => {
    if (view.state.doc.eq(doc)) {
      view.dispatch({ changes, userEvent: "input.fix" });
    }
  };
  return [{ name: title, apply }];
}

function diagnosticsOf(state: EditorState): Diagnostic[] {
  const found: Diagnostic[] = [];
  forEachDiagnostic(state, (diagnostic, from, to) => found.push({ ...diagnostic, from, to }));
  return found;
}

function fixable(state: EditorState, place: number): Diagnostic[] {
  const line = state.doc.lineAt(place);
  return diagnosticsOf(state).filter(
    ({ from, to, actions }) => from <= line.to && to >= line.from && (actions ?? []).length > 0,
  );
}

const listAt = StateEffect.define<number | null>();

const list = StateField.define<Tooltip | null>({
  create: () => null,
  update: (shown, transaction) => {
    const asked = transaction.effects.find(effect => effect.is(listAt));
    if (asked !== undefined) {
      return asked.value === null ? null : { pos: asked.value, create: view => listView(view, asked.value as number) };
    }
    return transaction.docChanged || transaction.selection !== undefined ? null : shown;
  },
  provide: field => showTooltip.from(field),
});

function listView(view: EditorView, place: number): { dom: HTMLElement; mount: () => void } {
  const close = (): void => {
    view.dispatch({ effects: listAt.of(null) });
    view.focus();
  };
  const choose = (action: Action, { from, to }: Diagnostic): void => {
    close();
    action.apply(view, from, to);
  };
  const buttons = fixable(view.state, place).flatMap(found =>
    (found.actions ?? []).map(action => button(action.name, () => choose(action, found), { role: "menuitem" })),
  );
  const dom = element("div", { class: "cm-fix-list", role: "menu", "aria-label": "Quick fixes" }, ...buttons);
  dom.addEventListener("keydown", event => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step !== undefined) {
      const at = buttons.indexOf(event.target as HTMLButtonElement);
      buttons[(at + step + buttons.length) % buttons.length]?.focus();
    } else if (event.key === "Escape" || event.key === "Tab") {
      close();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  });
  return { dom, mount: () => buttons[0]?.focus() };
}

/** Shows the fixes for the line of a place; whether there are any. */
function open(view: EditorView, place: number): boolean {
  const [first] = fixable(view.state, place);
  if (first === undefined) {
    return false;
  }
  view.dispatch({ effects: listAt.of(first.from) });
  return true;
}

class FixSign extends GutterMarker {
  override toDOM(): Node {
    return element("span", { class: "cm-fix-sign", title: "Quick fix (Ctrl-.)" }, "✎");
  }
}

const sign = new FixSign();

const signs = gutter({
  class: "cm-fixes",
  lineMarker: (view, line) => (fixable(view.state, line.from).length > 0 ? sign : null),
  lineMarkerChange: ({ transactions }) =>
    transactions.some(made => made.effects.some(effect => effect.is(setDiagnosticsEffect))),
  domEventHandlers: { click: (view, line) => open(view, line.from) },
});

const look = EditorView.theme({
  ".cm-fix-list": { display: "grid", padding: "4px", gap: "2px" },
  ".cm-fix-list button": {
    font: "inherit",
    color: "inherit",
    textAlign: "left",
    padding: "4px 10px",
    background: "none",
    border: "0",
    borderRadius: "4px",
  },
  ".cm-fix-list button:focus": { backgroundColor: "var(--accent)", color: "var(--on-accent)", outline: "none" },
  ".cm-fixes": { minWidth: "1.2em" },
  ".cm-fix-sign": { cursor: "pointer", color: "var(--accent)" },
});

export function quickFixes(): Extension {
  const key = { key: "Mod-.", run: (view: EditorView) => open(view, view.state.selection.main.head) };
  return [asking, list, signs, keymap.of([key]), look];
}
