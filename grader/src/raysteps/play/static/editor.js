// The editor: CodeMirror with C++, the compiler's words at their lines, and the names of the step's contract.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { cppLanguage } from "@codemirror/lang-cpp";
import { bracketMatching, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";

const COLORS = HighlightStyle.define([
  { tag: [tags.keyword, tags.modifier, tags.controlKeyword], color: "var(--code-keyword)" },
  { tag: [tags.typeName, tags.namespace, tags.className], color: "var(--code-type)" },
  { tag: [tags.number, tags.bool, tags.string, tags.character], color: "var(--code-value)" },
  { tag: [tags.comment, tags.lineComment, tags.blockComment], color: "var(--muted)", fontStyle: "italic" },
  { tag: [tags.processingInstruction, tags.meta], color: "var(--code-keyword)" },
]);

const LOOK = EditorView.theme({
  "&": { height: "100%", fontSize: "0.875rem", color: "var(--ink)", backgroundColor: "var(--panel)" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.5" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-gutters": { backgroundColor: "var(--sunken)", color: "var(--muted)", border: "none" },
  ".cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--accent) 7%, transparent)" },
  ".cm-activeLineGutter": { backgroundColor: "var(--sunken)", color: "var(--ink)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground, ::selection": {
    backgroundColor: "color-mix(in srgb, var(--accent) 28%, transparent) !important",
  },
  ".cm-panels, .cm-tooltip": { backgroundColor: "var(--panel)", color: "var(--ink)", borderColor: "var(--line)" },
});

/** What lies over the page at its edges, by the page's style: the caret does not go below it. */
function edges() {
  const { scrollPaddingTop, scrollPaddingBottom } = getComputedStyle(document.documentElement);
  return { top: Number.parseFloat(scrollPaddingTop) || 0, bottom: Number.parseFloat(scrollPaddingBottom) || 0 };
}

/** A name of the contract, offered while it is typed. */
function completions(names) {
  return (context) => {
    const word = context.matchBefore(/[A-Za-z_]\w*/);
    const options = names.map((label) => ({ label, type: "variable" }));
    return word && (context.explicit || word.to - word.from > 1) ? { from: word.from, options } : null;
  };
}

/** What is typed over a selection: a browser would do it with styles of its own, which the page's policy forbids. */
function typedOver(event, view) {
  const { from, to } = view.state.selection.main;
  if (view.state.readOnly) {
    event.preventDefault();
    return true;
  }
  if (event.inputType !== "insertText" || event.isComposing || !event.data || from === to) {
    return false;
  }
  const insert = () => view.state.update(view.state.replaceSelection(event.data), { userEvent: "input.type" });
  const handlers = view.state.facet(EditorView.inputHandler);
  if (!handlers.some((handler) => handler(view, from, to, event.data, insert))) {
    view.dispatch(insert());
  }
  event.preventDefault();
  return true;
}

/** Fills a room of the page with an editor. It stands in a shadow tree, whose styles no policy has to allow. */
export class Editor {
  #view;
  #names = [];
  #changed;
  #isLoading = false;

  constructor(room, label, changed) {
    this.#changed = changed;
    this.#view = new EditorView({ root: room.attachShadow({ mode: "open" }), parent: room.shadowRoot });
    this.label = label;
  }

  #extensions(isReadOnly) {
    return [
      EditorState.readOnly.of(isReadOnly),
      EditorView.editable.of(!isReadOnly),
      lineNumbers(),
      history(),
      drawSelection(),
      EditorState.tabSize.of(4),
      indentUnit.of("    "),
      indentOnInput(),
      syntaxHighlighting(COLORS),
      bracketMatching(),
      closeBrackets(),
      autocompletion(),
      cppLanguage,
      cppLanguage.data.of({ autocomplete: completions(this.#names) }),
      highlightActiveLine(),
      highlightSelectionMatches(),
      lintGutter(),
      EditorView.lineWrapping,
      EditorView.scrollMargins.of(edges),
      LOOK,
      EditorView.domEventHandlers({ beforeinput: typedOver }),
      EditorView.contentAttributes.of({
        "aria-label": this.label,
        "aria-readonly": String(isReadOnly),
        spellcheck: "false",
        tabindex: "0",
      }),
      EditorView.updateListener.of((update) => {
        if (update.docChanged && !this.#isLoading) {
          this.#changed();
        }
      }),
      keymap.of([
        ...closeBracketsKeymap,
        ...defaultKeymap,
        ...searchKeymap,
        ...historyKeymap,
        ...completionKeymap,
        ...lintKeymap,
        indentWithTab,
      ]),
    ];
  }

  /** Begins with another text. */
  load(text, names, isReadOnly = false) {
    this.#names = names;
    this.#isLoading = true;
    this.#view.setState(EditorState.create({ doc: text, extensions: this.#extensions(isReadOnly) }));
    this.#isLoading = false;
  }

  get text() {
    return this.#view.state.doc.toString();
  }

  focus() {
    this.#view.focus();
  }

  /** Marks `{line, column, severity, message}`. */
  mark(problems) {
    const { doc } = this.#view.state;
    const diagnostics = problems.map(({ line, column, severity, message }) => {
      const place = doc.line(Math.min(Math.max(line, 1), doc.lines));
      const from = Math.min(place.from + Math.max(column - 1, 0), place.to);
      const word = /^\w+/.exec(doc.sliceString(from, place.to));
      return { from, to: from + (word ? word[0].length : 0), severity, message };
    });
    this.#view.dispatch(setDiagnostics(this.#view.state, diagnostics));
  }

  toTop() {
    this.#view.scrollDOM.scrollTop = 0;
  }

  /** Shows a line. */
  goTo(line) {
    const place = this.#view.state.doc.line(Math.min(Math.max(line, 1), this.#view.state.doc.lines));
    this.#view.dispatch({
      selection: { anchor: place.from },
      effects: EditorView.scrollIntoView(place.from, { y: "center" }),
    });
    this.#view.focus();
  }
}
