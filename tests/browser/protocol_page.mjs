// protocol/PROTOCOL.md as a value: its sections with their tables and fenced examples.
import { readFileSync } from "node:fs";

const text = readFileSync(new URL("../../protocol/PROTOCOL.md", import.meta.url), "utf8");

/** Fenced blocks marked with `mark`, such as "json client". */
export function examples(mark) {
    return [...text.matchAll(/^```([^\n]+)\n(.*?)^```$/gms)].filter(([, info]) => info.trim() === mark).map(([, , body]) => body);
}

const cellsOf = (line) => line.split("|").slice(1, -1).map((cell) => cell.trim().replace(/^`|`$/g, ""));

/** Tables below `heading` (up to the next of the same or a higher level), each an array of rows by column name. */
export function tablesUnder(heading) {
    const level = /^#+/.exec(heading)[0].length;
    const begin = text.indexOf(`\n${heading}`);
    if (begin < 0)
        throw new Error(`PROTOCOL.md has no heading '${heading}'`);
    const rest = text.slice(begin + 1 + heading.length);
    const end = rest.search(new RegExp(`^#{1,${level}} `, "m"));
    const tables = [];
    let columns = null;
    for (const line of rest.slice(0, end < 0 ? undefined : end).split("\n")) {
        if (!line.startsWith("|"))
            columns = null;
        else if (!columns)
            tables.push([], columns = cellsOf(line));
        else if (!/^\|[\s|:-]+$/.test(line))
            tables.at(-2).push(Object.fromEntries(cellsOf(line).map((cell, i) => [columns[i], cell])));
    }
    return tables.filter((_, i) => i % 2 === 0);
}

/** Names of the messages: the third-level headings of a section. */
export function messagesOf(section) {
    const rest = text.slice(text.indexOf(`\n${section}`) + 1);
    return [...rest.slice(0, rest.search(/\n## (?!#)/) + 1 || undefined).matchAll(/^### (\w+)$/gm)].map(([, name]) => name);
}

/** The bytes of a `hex frame` block: lines of an offset and up to 16 bytes. */
export function bytesOf(block) {
    const bytes = block.trim().split("\n").flatMap((line) => line.split(/\s+/).slice(1).map((pair) => parseInt(pair, 16)));
    return Uint8Array.from(bytes).buffer;
}
